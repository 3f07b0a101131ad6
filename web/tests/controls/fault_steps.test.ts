import { beforeEach, expect, test } from "vitest";
import { inTissue, nextStep, waitingFor } from "../../src/controls/fault_banner.ts";
import { type Ask, DONE, type Engine, type EngineListener } from "../../src/engine/engine.ts";
import { App } from "../../src/state/app.ts";
import type { Hello, Message, SceneView, Status } from "../../src/wire/messages.ts";
import { batch } from "../support/fill_history.ts";
import { LIMITS } from "../support/limits.ts";

let server: EngineListener;
let asked: Ask[];
let app: App;

const say = (message: unknown): void => server.message(message as Exclude<Message, { kind: "reply" }>);
const hello = (simulated: boolean, buttons: number[] = []): void =>
  say({
    kind: "hello",
    device: { simulated, model: "Omni" },
    limits: { ...LIMITS, dead_man_buttons: buttons },
  } as Partial<Hello>);
const tipAt = (y: number): void => server.ticks(batch(app.live.history.end, 1, 1, { position: () => [0, y, 0] }));

beforeEach(() => {
  asked = [];
  const engine: Engine = {
    studio: true,
    start: (listener) => {
      server = listener;
    },
    stop: () => {},
    target: () => {},
    ask: async (request) => {
      asked.push(request);
      return { kind: "reply", id: 0, ...DONE };
    },
  };
  app = new App(engine);
  app.start();
  server.connection({ state: "open" });
  const membrane = { name: "skin", point: [0, -1e-3, 0], inward_normal: [0, -1, 0], thickness: 1e-3 };
  say({ kind: "scene", scene: { membranes: [membrane], laws: [] } as unknown as SceneView, new_run: true, run: 0 });
  say({ kind: "control", holder: 1, you: true, hand: null });
  hello(true);
  tipAt(5e-3);
});

test("the tip is in tissue behind the first surface; a position that is not a number says nothing", () => {
  expect(inTissue(app)).toBe(false);
  tipAt(-2e-3);
  expect(inTissue(app)).toBe(true);
  tipAt(Number.NaN);
  expect(inTissue(app)).toBeNull();
});

test("outside tissue the button ends the fault and turns the force on", async () => {
  nextStep(app).act?.();
  await Promise.resolve();
  await Promise.resolve();
  expect(asked.map((request) => request.do)).toEqual(["reset", "arm"]);
});

test("in tissue the needle must come out first: the page moves a simulated hand, and asks for nothing else", () => {
  tipAt(-2e-3);
  const step = nextStep(app);
  expect(step.sentence).toContain("draw the needle out of the tissue");
  step.act?.();
  expect(asked).toEqual([]);
  hello(false);
  expect(nextStep(app).act).toBeNull(); // a person holds it
});

test("strokes bring the needle out by themselves", () => {
  tipAt(-2e-3);
  say({ kind: "status", hand: "strokes" } as Partial<Status>);
  expect(nextStep(app).label).toBe("Turn force on");
});

test("a page without control offers to take it", () => {
  say({ kind: "control", holder: 2, you: false, hand: null });
  nextStep(app).act?.();
  expect(asked.map((request) => request.do)).toEqual(["take_control"]);
});

test("the header says for what the force waits", () => {
  tipAt(-2e-3);
  expect(waitingFor(app)).toBe("Waiting: draw the needle out of the tissue");
  tipAt(5e-3);
  expect(waitingFor(app)).toBe("Waiting");
  hello(true, [1, 3]);
  expect(waitingFor(app)).toBe("Waiting: hold button 1 or 3 of the device");
});
