import { Vector3 } from "three";
import { describe, expect, it } from "vitest";
import { BARRED, Moment, OUTSIDE } from "../../src/scene/moment.ts";
import { Level } from "../../src/scene/needle_level.ts";
import { needleLook } from "../../src/scene/needle_look.ts";
import { atTip } from "../../src/scene/needle_space.ts";
import { plainScene } from "../support/plain_scene.ts";

const SLIDING_IN = 2;
const scene = plainScene; // skin, front wall 0.4 mm thick, back wall

function moment(...states: readonly (readonly [phase: number, depth: number])[]): Moment {
  const made = new Moment();
  made.membranes = states.map(([phase, depth]) => ({
    phase,
    depth,
    proxy: new Vector3(),
    direction: new Vector3(0, -1, 0),
  }));
  return made;
}

it.each([
  [SLIDING_IN, 0.39, OUTSIDE, "tissue"],
  [SLIDING_IN, 0.41, OUTSIDE, "blood"],
  [SLIDING_IN, 3.5, SLIDING_IN, "tissue"],
  [OUTSIDE, 0.41, OUTSIDE, "tissue"],
  [BARRED, 0.41, OUTSIDE, "tissue"],
])(
  "with the front wall in phase %d at %d mm and the back wall in phase %d, the tip is in %s",
  (phase, depth, back, content) => {
    const now = moment([SLIDING_IN, 5], [phase, depth], [back, 0.2]);
    expect(atTip(now, scene, scene.laws).content).toBe(content);
  },
);

it("a needle in front of the skin is outside, and without a law nothing is known", () => {
  expect(atTip(moment([OUTSIDE, 0], [OUTSIDE, 0], [OUTSIDE, 0]), scene, scene.laws).content).toBe("outside");
  expect(atTip(moment([SLIDING_IN, 5], [SLIDING_IN, 1], [OUTSIDE, 0]), scene, []).content).toBe("outside");
});

it("the opening is free by the share of the tip that is past the membrane", () => {
  const past = (depth: number): number =>
    atTip(moment([SLIDING_IN, 9], [SLIDING_IN, depth], [OUTSIDE, 0]), scene, scene.laws).open;
  const tip = scene.tip_length * 1000;
  expect(past(0.4 + 0.5 * tip)).toBeCloseTo(0.5, 6);
  expect(past(0.4 + 2 * tip)).toBe(1);
});

it("a space has the content that the scene's file gives it", () => {
  const membranes = scene.membranes.map((m, i) => (i === 1 ? { ...m, behind: "epidural space" as const } : m));
  const given = { ...scene, membranes };
  expect(needleLook(given)).toBe("tuohy");
  expect(needleLook(scene)).toBe("hypodermic");
  expect(atTip(moment([SLIDING_IN, 9], [SLIDING_IN, 2], [OUTSIDE, 0]), given, scene.laws).content).toBe(
    "epidural space",
  );
});

describe("a level", () => {
  it("follows its goal in the run's time, and stands still while the run does", () => {
    const level = new Level();
    level.step(0, 1, 3);
    expect(level.step(1, 1.1, 3)).toBe(true);
    const after = level.value;
    expect(after).toBeGreaterThan(0.2);
    expect(level.step(1, 1.1, 3)).toBe(false);
    for (let time = 1.2; time < 4; time += 0.1) level.step(1, time, 3);
    expect(level.value).toBe(1);
  });

  it("takes its goal at once where a replay jumps", () => {
    const level = new Level();
    level.step(0, 10, 3);
    level.step(1, 20, 3);
    expect(level.value).toBe(1);
    level.step(0, 5, 3);
    expect(level.value).toBe(0);
  });

  it("moves evenly if asked to", () => {
    const level = new Level();
    level.step(0, 0, 1, true);
    level.step(1, 0.25, 2, true);
    expect(level.value).toBeCloseTo(0.5, 9);
  });
});
