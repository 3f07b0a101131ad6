import { afterEach, beforeEach, expect, it, vi } from "vitest";
import { type Ask, DONE, type Engine, type EngineListener } from "../../src/engine/engine.ts";
import { FIRM, Thumb } from "../../src/hand/thumb.ts";
import { App } from "../../src/state/app.ts";
import { Source } from "../../src/state/source.ts";
import type { SceneView } from "../../src/wire/messages.ts";

let server: EngineListener;
let sent: number[];
let app: App;
let thumb: Thumb;
let listeners: Map<string, (event: { key?: string }) => void>; // of the window

const control = (you: boolean): void => server.message({ kind: "control", holder: 1, you, hand: null });
const scene = (syringe: boolean, run = 0): void =>
  server.message({
    kind: "scene",
    scene: {
      membranes: [{}],
      laws: [],
      number: 0,
      syringe: syringe ? { bore: 0.012, volume: 5e-6 } : null,
    } as unknown as SceneView,
    new_run: true,
    run,
  });

beforeEach(() => {
  sent = [];
  listeners = new Map();
  vi.stubGlobal("addEventListener", (name: string, listener: () => void) => listeners.set(name, listener));
  const engine: Partial<Engine> = {
    start: (listener: EngineListener) => {
      server = listener;
    },
    ask: async (request: Ask) => {
      if (request.do === "push_plunger") sent.push(request.force);
      return { kind: "reply", id: 1, ...DONE };
    },
  };
  app = new App(engine as Engine);
  app.start();
  server.connection({ state: "open" });
  thumb = new Thumb(app);
  control(true);
  scene(true);
});

afterEach(() => {
  vi.unstubAllGlobals();
});

it("pushes while something holds it, and lets go with the last of them", () => {
  thumb.push("key", FIRM);
  thumb.push("trigger", FIRM + 2);
  thumb.push("trigger", 0);
  thumb.push("key", 0);
  expect(sent).toEqual([FIRM, FIRM + 2, FIRM, 0]);
});

it("says again that it pushes, so that the server does not let go", () => {
  thumb.push("key", FIRM, 0);
  thumb.renew(100);
  expect(sent).toEqual([FIRM]);
  thumb.renew(500);
  expect(sent).toEqual([FIRM, FIRM]);
  thumb.push("key", 0, 600);
  thumb.renew(2000);
  expect(sent).toEqual([FIRM, FIRM, 0]);
});

it("lets go when a run begins, when another page takes control and when the scene has no plunger", () => {
  thumb.push("key", FIRM);
  scene(true, 1);
  expect(sent).toEqual([FIRM, 0]);
  thumb.push("key", FIRM);
  control(false);
  expect(sent).toEqual([FIRM, 0, FIRM, 0]);
  control(true);
  scene(false, 2);
  thumb.push("key", FIRM);
  expect(sent).toEqual([FIRM, 0, FIRM, 0]);
});

it("lets go when the page shows another run", () => {
  thumb.push("key", FIRM, 0);
  app.source.value = new Source("recording", false, 4);
  thumb.renew(10);
  expect([thumb.force.value, sent.at(-1)]).toEqual([0, 0]);
  app.goLive();
  thumb.renew(1000);
  expect(sent.at(-1)).toBe(0);
});

it("pushes while the wheel turns, lets go soon after it, and at once when it turns back", () => {
  thumb.turn(100, 0);
  thumb.renew(240);
  thumb.turn(100, 240); // the next notch, before the push has ended
  thumb.renew(390);
  expect(sent).toEqual([FIRM]);
  thumb.renew(510);
  expect(sent).toEqual([FIRM, 0]);
  for (let notch = 0; notch < 20; notch++) thumb.turn(100, 1000);
  thumb.renew(1401); // however far it was turned
  expect(sent).toEqual([FIRM, 0, FIRM, 0]);
  thumb.turn(100, 2000);
  thumb.turn(-100, 2010);
  expect(sent).toEqual([FIRM, 0, FIRM, 0, FIRM, 0]);
});

it("a released Alt ends the push of the wheel, not that of a key", () => {
  thumb.turn(100, 0);
  listeners.get("keyup")?.({ key: "Shift" });
  expect(sent).toEqual([FIRM]);
  listeners.get("keyup")?.({ key: "Alt" });
  expect(sent).toEqual([FIRM, 0]);
  thumb.push("key", FIRM, 100);
  listeners.get("keyup")?.({ key: "Alt" });
  expect(sent).toEqual([FIRM, 0, FIRM]);
});

it("a wheel that stops does not end the push of a key", () => {
  thumb.push("key", FIRM, 0);
  thumb.turn(100, 0);
  thumb.renew(300);
  thumb.turn(-100, 310);
  expect([sent, thumb.force.value]).toEqual([[FIRM], FIRM]);
});

it("does not push with the wheel in a scene without a plunger, or without control", () => {
  scene(false, 1);
  thumb.turn(100, 0);
  scene(true, 2);
  control(false);
  thumb.turn(100, 100);
  expect(sent).toEqual([]);
});
