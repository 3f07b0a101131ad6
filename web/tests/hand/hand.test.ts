import { beforeEach, describe, expect, it } from "vitest";
import { lagText } from "../../src/controls/hand/place.ts";
import type { EngineListener, Triple } from "../../src/engine/engine.ts";
import { Hand, LARGEST_TILT_DEG } from "../../src/hand/hand.ts";
import { App } from "../../src/state/app.ts";
import { Source } from "../../src/state/source.ts";
import type { DevicePart, SceneView, Status } from "../../src/wire/messages.ts";
import { decodeTicks } from "../../src/wire/ticks.ts";
import { LIMITS } from "../support/limits.ts";
import { makeFrame } from "../wire/frame.ts";

const DEVICE: DevicePart = {
  backend: "simulated", model: "PHANTOM Omni", simulated: true, has_orientation: true, max_force: 3.3, rate: 1600,
}; // biome-ignore format: short

let server: EngineListener;
let sent: { run: number; position: Triple; axis: Triple }[];
let app: App;
let hand: Hand;

const status = (mode: Status["hand"]): void => server.message({ kind: "status", hand: mode } as Status);
const hello = (device: DevicePart): void =>
  server.message({
    kind: "hello",
    protocol: 1,
    version: "",
    viewer: 1,
    device,
    limits: LIMITS,
    scenes: [],
    exercises: [],
    second_device: "",
    figures: false,
  });

/** A tick with the needle at a place, pointing down. */
function tick(position: Triple): void {
  const batch = decodeTicks(makeFrame({ first: app.live.history.end, count: 1, membranes: 1 }));
  batch.floats.position.set(position);
  batch.floats.tip.set(position);
  batch.floats.axis.set([0, -1, 0]);
  server.ticks(batch);
}

/** A new run begins. */
const run = (number: number): void =>
  server.message({
    kind: "scene",
    scene: { membranes: [{}], laws: [], number: 0 } as unknown as SceneView,
    new_run: true,
    run: number,
  });

beforeEach(() => {
  sent = [];
  app = new App({
    studio: true,
    start: (listener) => {
      server = listener;
    },
    stop: () => {},
    ask: () => Promise.reject(new Error("nobody asks here")),
    target: (run, position, axis) => sent.push({ run, position, axis }),
  });
  app.start();
  hand = new Hand(app);
  server.connection({ state: "open" });
  hello(DEVICE);
  server.message({ kind: "control", holder: 1, you: true, hand: null });
  tick([0, 0.01, 0]);
});

describe("the hand", () => {
  it("has a lag only with a target, and the page shows the unit without one too", () => {
    expect(hand.lag()).toBeNull();
    expect(lagText(hand.lag())).toBe("– mm");
    hand.push(0.001);
    expect(lagText(hand.lag())).toBe("1.00 mm");
  });

  it("starts at the needle, and continues from the last target", () => {
    hand.push(0.001);
    expect(sent[0]!.position[1]).toBeCloseTo(0.009, 8);
    expect(sent[0]!.axis).toEqual([0, -1, 0]);
    tick([0, 0.0095, 0]); // it lags
    hand.push(0.001);
    expect(sent[1]!.position[1]).toBeCloseTo(0.008, 8);
    expect(hand.lag()).toBeCloseTo(0.0015, 8);
  });

  it("tilts about its target, up to the largest tilt of the page", () => {
    hand.setTilt(0.5);
    expect(hand.tilt()).toBeCloseTo(0.5, 9);
    hand.setTilt(2);
    expect(hand.tilt()).toBeCloseTo((LARGEST_TILT_DEG * Math.PI) / 180, 9);
    expect(sent.at(-1)!.position[1]).toBeCloseTo(0.01, 8);
  });

  it("aims at the middle of the scene when it is turned in front of it, as far from the skin as before", () => {
    const membranes = [{ name: "skin", point: [0, 0, 0], inward_normal: [0, -1, 0], thickness: 0.006 }];
    server.message({
      kind: "scene",
      scene: { membranes, laws: [], number: 0 } as unknown as SceneView,
      new_run: false,
      run: 0,
    });
    for (const angle of [0.3, -0.9, 1.2]) {
      hand.setTilt(angle);
      const { position, axis } = sent.at(-1)!;
      expect(position[1]).toBeCloseTo(0.01, 8);
      const along = (position[1] + 0.003) / -axis[1];
      expect(position[0] + along * axis[0]).toBeCloseTo(0, 8);
    }
    hand.push(0.05); // now it is in
    const { position } = sent.at(-1)!;
    hand.setTilt(0);
    expect(sent.at(-1)!.position).toEqual(position);
  });

  it("moves along the tilted needle", () => {
    hand.setTilt(Math.PI / 6);
    hand.push(0.002);
    const [x, y] = sent.at(-1)!.position;
    expect([x, y]).toEqual([expect.closeTo(0.001, 8), expect.closeTo(0.01 - 0.002 * Math.cos(Math.PI / 6), 8)]);
  });

  it("limits far targets, and ignores targets that are not finite", () => {
    hand.moveTo([10, 0, 0]);
    expect(Math.hypot(...sent.at(-1)!.position)).toBeCloseTo(0.25, 9);
    hand.moveTo([Number.NaN, 0, 0]);
    expect(sent).toHaveLength(1);
  });

  it.each([
    [
      "another page has control",
      () => server.message({ kind: "control", holder: 2, you: false, hand: null }),
      "Another page",
    ],
    ["the device is a real one", () => hello({ ...DEVICE, simulated: false, model: "omega.3" }), "omega.3"],
    [
      "the connection has gone",
      () => server.connection({ state: "lost", reason: "", retryInMs: 1 }),
      "does not answer",
    ],
    [
      "a recording is shown",
      () => {
        app.source.value = new Source("recording", false, 10);
      },
      "recording",
    ],
  ])("says why it cannot be moved where %s, and is not", (_name, happen, words) => {
    hand.push(0.001);
    happen();
    expect(hand.barred.value).toContain(words);
    expect(hand.target.value).toBeNull();
    hand.push(0.001);
    hand.setTilt(0.3);
    expect(sent).toHaveLength(1);
  });

  it("of a new run begins where the server puts it, and says for which run it is led", () => {
    hand.push(0.001);
    run(4);
    expect(hand.target.value).toBeNull();
    hand.push(0.001); // nothing has come of the new run yet
    expect(sent).toHaveLength(1);
    tick([0, 0.005, 0]);
    hand.push(0.001);
    expect(sent.map((target) => target.run)).toEqual([0, 4]);
    expect(sent[1]!.position[1]).toBeCloseTo(0.004, 8);
  });

  it("that a page finds on joining is led on from where it is, not from where tissue holds the needle", () => {
    const slanted: [number, number, number] = [Math.sin(Math.PI / 3), -Math.cos(Math.PI / 3), 0];
    server.message({ kind: "control", holder: 2, you: false, hand: null });
    server.message({ kind: "control", holder: 1, you: true, hand: { position: [0, 0.002, 0], axis: slanted } });
    expect(hand.tilt()).toBeCloseTo(Math.PI / 3, 9);
    hand.moveBy([0, -0.001, 0]);
    expect(sent[0]!.position[1]).toBeCloseTo(0.001, 8);
    expect(sent[0]!.axis[0]).toBeCloseTo(slanted[0], 8);
  });

  it("drops its target when strokes start, unless it was moved just now", () => {
    hand.push(0.001);
    status("strokes"); // on its way when the hand was taken
    expect(hand.target.value).not.toBeNull();
    hand.release();
    expect(hand.target.value).toBeNull();
    status("strokes");
    tick([0, -0.005, 0]);
    hand.hold();
    expect(sent.at(-1)!.position[1]).toBeCloseTo(-0.005, 8);
  });
});
