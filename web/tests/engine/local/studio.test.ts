import { beforeEach, describe, expect, it } from "vitest";
import { LocalStudio } from "../../../src/engine/local/studio.ts";
import type { Message } from "../../../src/wire/messages.ts";
import { decodeTicks } from "../../../src/wire/ticks.ts";
import { FakeCore } from "./fake_core.ts";

const DATA = {
  version: "1.2.3",
  protocol: 9,
  first: "vein",
  scenes: [
    { name: "vein", title: "Vein", tables: { name: "Vein" } },
    { name: "skin", title: "Skin", tables: { name: "Skin" } },
  ],
  faults: { non_finite_input: ["It was no number.", "Check the cable."] },
  still_off: "The force is still off.",
} as const;
const SCHEMA = { properties: { name: {}, servo: { properties: { rate_hz: { default: 1600 } } } } };

let core: FakeCore;
let messages: Message[];
let frames: ArrayBuffer[];
let now: number;
let studio: LocalStudio;

const last = <K extends Message["kind"]>(kind: K): Extract<Message, { kind: K }> =>
  messages.findLast((message) => message.kind === kind) as Extract<Message, { kind: K }>;
const advance = (ms: number): void => {
  now += ms;
  studio.turn();
};

beforeEach(() => {
  core = new FakeCore();
  messages = [];
  frames = [];
  now = 0;
  const out = { message: (m: Message) => messages.push(m), frame: (f: ArrayBuffer) => frames.push(f) };
  studio = new LocalStudio(core.punctura, DATA, SCHEMA, out, () => now);
  studio.start();
  studio.turn();
});

describe("the studio in a page", () => {
  it("begins like the server: hello, control, no fault, scene; and armed", () => {
    expect(messages.slice(0, 4).map(({ kind }) => kind)).toEqual(["hello", "control", "fault", "scene"]);
    expect(last("hello")).toMatchObject({
      version: "1.2.3",
      protocol: 9,
      device: { model: "fake", simulated: true },
      scenes: [{ name: "vein" }, { name: "skin" }],
      exercises: [],
    });
    expect(last("control").you).toBe(true);
    expect(last("scene")).toMatchObject({ run: 0, new_run: true });
    expect(last("scene").scene.tables).toEqual({ name: "Vein", servo: { rate_hz: 1600 } });
    expect(core.told).toEqual(["run 0: Vein", "arm"]);
  });

  it("sends every tick in frames, and then the messages of the run", () => {
    advance(10);
    advance(5);
    expect(frames.map((frame) => decodeTicks(frame)).map(({ firstTick, count }) => [firstTick, count])).toEqual([
      [0, 16],
      [16, 8],
    ]);
    expect(messages.at(-1)?.kind).toBe("laws");
  });

  it("starts a run with a ready scene or a file, and none with problems", () => {
    expect(studio.ask({ do: "load", scene: "skin" })).toMatchObject({ ok: true });
    expect(last("scene")).toMatchObject({ run: 1, new_run: true, scene: { tables: { name: "Skin" } } });
    expect(studio.ask({ do: "load_text", toml: 'name = "Own"' })).toMatchObject({ ok: true });
    expect(last("scene")).toMatchObject({ run: 2, scene: { tables: { name: "Own" } } });
    const before = core.told.length;
    expect(studio.ask({ do: "load_text", toml: 'name = "BAD"' })).toMatchObject({
      ok: false,
      text: "1 problem",
      problems: [{ path: "membrane[0].friction", value: "-1", reason: "must be greater than 0" }],
    });
    expect(core.told).toHaveLength(before);
    expect(last("scene").run).toBe(2);
    expect(studio.ask({ do: "load", scene: "none" })).toMatchObject({
      ok: false,
      text: "there is no ready scene none",
    });
    const exercise = studio.ask({ do: "load_text", toml: "[[goal]]" });
    expect(exercise.text).toMatch(/^This is an exercise, not a scene\. This needs/);
    expect(last("scene").run).toBe(2);
  });

  it("exchanges the scene within the run, after the ticks of the old one", () => {
    now += 10;
    expect(studio.ask({ do: "edit", tables: { name: "Mine" } })).toMatchObject({ ok: true });
    expect(frames).toHaveLength(1);
    expect(last("scene")).toMatchObject({ run: 0, new_run: false, scene: { tables: { name: "Mine" } } });
    const later = studio.ask({ do: "edit", tables: { name: "Mine", servo: { rate_hz: 2000 } } });
    expect(later).toMatchObject({ ok: true, text: "the new rate takes effect in the next run" });
    expect(studio.ask({ do: "edit", tables: { name: "BAD" } }).ok).toBe(false);
    expect(last("scene").scene.tables.name).toBe("Mine");
  });

  it("tells a fault once, with its words, and its end", () => {
    advance(10);
    core.fault = 1;
    advance(10);
    advance(10);
    const faults = messages.filter((message) => message.kind === "fault");
    expect(faults).toHaveLength(2); // the first one is that of the start
    expect(last("fault")).toMatchObject({
      fault: "non_finite_input",
      reason: "It was no number.",
      remedy: "Check the cable.",
      tick: 16,
      kept: 0,
    });
    core.fault = 0;
    advance(10);
    expect(last("fault")).toMatchObject({ fault: "none", reason: "" });
  });

  it("moves the hand of this run only", () => {
    studio.target(0, [1, 2, 3], [0, -1, 0], 0);
    studio.target(4, [9, 9, 9], [0, -1, 0], 0);
    expect(core.told.filter((line) => line.startsWith("target"))).toEqual(["target 1,2,3"]);
  });

  it("lets go of a plunger that is no longer pushed, and refuses one that is not there", () => {
    expect(studio.ask({ do: "push_plunger", force: 3 })).toMatchObject({ ok: false, text: "the scene has no syringe" });
    core.syringe = { bore: 9e-3, volume: 1e-5 };
    studio.ask({ do: "load", scene: "skin" });
    expect(studio.ask({ do: "push_plunger", force: 3 })).toMatchObject({ ok: true });
    advance(900);
    expect(core.told.at(-1)).toBe("push 3");
    advance(200);
    expect(core.told.at(-1)).toBe("push 0");
  });

  it("tells its state", () => {
    studio.ask({ do: "pause" });
    studio.ask({ do: "strokes" });
    studio.ask({ do: "compare", on: true });
    advance(1000);
    studio.tellStatus();
    expect(last("status")).toMatchObject({ ticks: 160, lost: 1440, armed: false, hand: "strokes", compare: true });
    expect(last("status").statements.join()).toContain("1,440 ticks were left out");
    studio.ask({ do: "load", scene: "skin" });
    expect(core.told.slice(-2)).toEqual(["free", "compare true"]);
  });

  const armings = (): number => core.told.filter((line) => line === "arm").length;
  it.each([
    ["it was turned off", () => void studio.ask({ do: "pause" })],
    [
      "a fault",
      () => {
        core.fault = 1;
        advance(10);
        core.fault = 0;
      },
    ],
    ["a reset", () => void studio.ask({ do: "reset" })],
  ])("turns the force on after %s only if it is asked to", (_, act) => {
    act();
    studio.ask({ do: "load", scene: "skin" });
    expect(last("notice")).toMatchObject({ text: "The force is still off." });
    studio.ask({ do: "load_text", toml: 'name = "Own"' });
    studio.tellStatus();
    expect(last("status").armed).toBe(false);
    expect(armings()).toBe(1); // that of the start
    studio.ask({ do: "arm" });
    studio.ask({ do: "load", scene: "skin" });
    studio.tellStatus();
    expect(last("status").armed).toBe(true);
    expect(armings()).toBe(3);
  });

  it("says of everything that needs a disk or Python that it needs the studio", () => {
    for (const request of [
      { do: "start_recording" },
      { do: "start_exercise", exercise: "a" },
      { do: "play_motion", recording: "a" },
    ] as const)
      expect(studio.ask(request)).toMatchObject({ ok: false, text: expect.stringContaining("needs the studio") });
  });
});
