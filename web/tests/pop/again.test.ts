import { beforeEach, expect, it } from "vitest";
import { Playback, SLOWDOWNS } from "../../src/controls/recordings/playback.ts";
import { showingOf } from "../../src/controls/recordings/showing.ts";
import { Plots } from "../../src/plots/shared.ts";
import { leaveExcerpt, showAgain, showLastAgain, showMoment } from "../../src/pop/again.ts";
import { ringOf } from "../../src/pop/ring.ts";
import { App } from "../../src/state/app.ts";
import { Source } from "../../src/state/source.ts";
import type { MembraneEvent, SceneView } from "../../src/wire/messages.ts";
import { FakeEngine } from "../controls/support/fake_engine.ts";
import { batch } from "../support/fill_history.ts";

const RATE = 1000; // of the made-up batches
let app: App;

const popAt = (tick: number): MembraneEvent =>
  ({ kind: "event", what: "pop", membrane: 0, name: "skin", tick, time: tick / RATE, drop: 0.5 }) as MembraneEvent;
const push = (source: Source, count: number): void =>
  source.history.push(batch(source.history.end, count, 1, { depth: (tick) => [tick * 1e-6] }));

beforeEach(() => {
  app = new App(new FakeEngine({} as SceneView));
  app.live.scene.value = { rate: RATE, membranes: [{}] } as unknown as SceneView;
  push(app.live, 2000);
  app.live.events.value = [popAt(1200)];
});

it("shows the 100 ms around the pop, and keeps them while the live run goes on", () => {
  expect(showAgain(app, popAt(1200))).toBe(true);
  const { value: shown } = app.source;
  expect([shown.live, shown.excerpt?.first, shown.excerpt?.last]).toEqual([false, 1150, 1250]);
  push(app.live, 200_000); // the live history has overwritten the pop
  expect(app.live.history.first).toBeGreaterThan(1250);
  expect(shown.history.row("depth", 1200)[0]).toBeCloseTo(1.2e-3, 9);
  leaveExcerpt(app);
  expect(app.source.value).toBe(app.live);
  expect(showAgain(app, popAt(1200))).toBe(false);
  expect(app.notices.value[0]).toContain("too old");
});

it("slows the clock by the chosen factor, from the first to the last tick", () => {
  showLastAgain(app);
  const showing = showingOf(app, app.source.value);
  expect(showing.speeds.map(([speed]) => Math.round(1 / speed))).toEqual([...SLOWDOWNS]);
  for (const times of SLOWDOWNS) {
    const playback = new Playback(showing.first, showing.last, RATE);
    playback.speed = 1 / times;
    playback.play();
    playback.advance(0.05 * times); // half of the 100 ms
    expect(playback.tick).toBe(1200);
    playback.advance(0.05 * times + 1e-6);
    expect([playback.tick, playback.playing]).toEqual([1250, false]);
  }
  expect(
    [showing.time(1200), showing.time(1150), showing.time(1250)].map((text) => text.replaceAll("\u2007", "")),
  ).toEqual(["+0.0 ms", "−50.0 ms", "+50.0 ms"]);
});

it("shows the same tick in the view and in the plots, which show just these 100 ms", () => {
  const plots = new Plots(app);
  showLastAgain(app);
  app.source.value.cursor.value = 1207;
  const window = plots.update();
  expect(plots.source.shown()).toBe(1207);
  expect(app.source.value.shown()).toBe(1207);
  app.source.value.cursor.value = 1160;
  showLastAgain(app); // anew, also before its pop
  expect(app.source.value.shown()).toBe(1150);
  app.source.value.cursor.value = 1207;
  expect([window.from.toFixed(6), window.to.toFixed(6)]).toEqual(["1.150000", "1.250000"]);
});

it("works in the replay of a recording, and goes back to it at the same tick", () => {
  const recording = new Source("recording", false, 4000);
  recording.scene.value = app.live.scene.value;
  recording.events.value = [popAt(700), popAt(1300)];
  push(recording, 3000);
  recording.cursor.value = 1250;
  app.source.value = recording;
  showLastAgain(app);
  expect(app.source.value.excerpt?.tick).toBe(700); // the last one before the shown tick
  expect(app.source.value.history).toBe(recording.history);
  leaveExcerpt(app);
  expect([app.source.value.title, recording.cursor.value]).toEqual(["recording", 1250]);
});

it("shows the second around the worst moment of a recorded attempt in 3 s, and the live run after it", () => {
  const recording = new Source("attempt", false, 4000);
  recording.scene.value = app.live.scene.value;
  push(recording, 3000);
  const start = recording.history.timeOf(recording.history.first);
  expect(showMoment(app, recording, start + 9)).toBe(false); // the page does not hold so much
  expect(showMoment(app, recording, start + 2)).toBe(true);
  const showing = showingOf(app, app.source.value);
  expect([showing.first, showing.last, showing.speed]).toEqual([1301, 2301, 1 / 3]); // their times have 32 bits
  expect([showing.kind, showing.backWords]).toEqual(["The moment, slowly:", "Back to live"]);
  leaveExcerpt(app);
  expect(app.source.value).toBe(app.live);
});

it("finds the worst moment of an attempt whose loop was late, and had fewer ticks in its seconds", () => {
  const recording = new Source("attempt", false, 4000);
  recording.scene.value = app.live.scene.value;
  push(recording, 2000);
  recording.history.push({ ...batch(2000, 1000, 1), firstTime: 4 }); // s
  expect(showMoment(app, recording, 4.5)).toBe(true);
  expect(app.source.value.excerpt?.tick).toBe(2500);
});

it("a ring grows from the pop on, and is gone after it; without motion it stays as it is", () => {
  const { live } = app;
  const at = (tick: number, still = false): number | undefined => {
    live.cursor.value = tick;
    return ringOf(live, still)?.radius;
  };
  push(live, 1000);
  expect(at(1199)).toBeUndefined();
  expect(at(1200)).toBeLessThan(at(1300)!);
  expect(at(1300)).toBeLessThan(at(1500)!);
  expect(at(2200)).toBeUndefined();
  expect(at(1210, true)).toBe(at(1900, true));
});
