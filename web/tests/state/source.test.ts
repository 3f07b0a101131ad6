import { describe, expect, it } from "vitest";
import type { Engine } from "../../src/engine/engine.ts";
import { plotsOf } from "../../src/plots/shared.ts";
import { App } from "../../src/state/app.ts";
import { Source } from "../../src/state/source.ts";
import { batch } from "../support/fill_history.ts";

const engine: Engine = { studio: true, start: () => {}, stop: () => {}, ask: () => Promise.reject(), target: () => {} };

function running(): App {
  const app = new App(engine);
  app.live.history.push(batch(0, 1000, 1));
  return app;
}

describe("the moment", () => {
  it("is the last tick of a live run, the timeline's tick, or the tick that somebody points at", () => {
    const source = new Source("test", true, 2000);
    expect(source.shown()).toBeNull();
    source.history.push(batch(0, 1000, 1));
    expect(source.shown()).toBe(999);
    source.cursor.value = 500;
    expect([source.present(), source.shown()]).toEqual([500, 500]);
    source.pointed.value = 20;
    expect([source.present(), source.shown()]).toEqual([500, 20]);
    source.pointed.value = null;
    expect(source.shown()).toBe(500);
  });

  it("pausing shows the live run's last tick everywhere, while the run goes on", () => {
    const app = running();
    app.pause();
    app.live.history.push(batch(1000, 1000, 1));
    const { value } = app.source;
    expect([value.live, value.paused, value.shown()]).toEqual([false, true, 999]);
    app.goLive();
    expect(app.source.value.shown()).toBe(1999);
  });

  it("a zoom pauses the live run, and its end goes back to it", () => {
    const app = running();
    const plots = plotsOf(app);
    plots.zoomTo(0.2, 0.4);
    expect(app.source.value.paused).toBe(true);
    plots.zoomTo(0.25, 0.3);
    plots.resetZoom();
    expect(app.source.value.live).toBe(true);
  });

  it("a jump to an event moves the timeline there; nobody points any more after a change of run", () => {
    const app = running();
    const plots = plotsOf(app);
    plots.point(700, "depth");
    expect(plots.jump(400)).toBe(true);
    expect(app.source.value.shown()).toBe(400);
    expect(app.live.pointed.value).toBeNull();
    expect(plots.jump(5000)).toBe(false);
  });
});
