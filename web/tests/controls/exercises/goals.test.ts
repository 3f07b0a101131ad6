import { expect, test } from "vitest";
import { lossText, stateWord, unfelt, verdict } from "../../../src/controls/exercises/goals.ts";
import type { ExerciseMetrics, Loss } from "../../../src/wire/files.ts";

const goals = (...states: ("met" | "missed" | "not measured")[]) => states.map((state) => ({ text: "a goal", state }));

const metrics = {} as ExerciseMetrics;
const loss = (membrane: number, drop: number, needed: number | null = 0.1): Loss => ({
  membrane,
  name: "wall",
  before: 0.5,
  after: 0.5 - drop,
  needed,
});

test("a pass with a goal that was not measured says so", () => {
  expect(verdict({ passed: true, goals: goals("met", "met"), metrics })).toBe("✓ passed");
  expect(verdict({ passed: true, goals: goals("met", "not measured"), metrics })).toBe(
    "✓ passed, but not everything was measured",
  );
  expect(verdict({ passed: false, goals: goals("missed", "not measured"), metrics })).toBe("✕ not passed");
});

test("a loss of resistance that the device could not show is no pass, and the verdict tells its size", () => {
  const losses = [loss(0, 0.3), loss(1, 0.04), loss(2, 0.01, null)];
  expect(verdict({ passed: false, goals: goals("met", "met"), metrics: { ...metrics, losses } })).toBe(
    "◐ not judged as passed: the device could not show the loss of resistance (0.04 N; 0.1 N needed)",
  );
  expect(verdict({ passed: false, goals: goals("met", "missed"), metrics: { ...metrics, losses } })).toBe(
    "✕ not passed",
  );
});

test("of each membrane the last pop counts", () => {
  expect(unfelt([loss(1, 0.04), loss(1, 0.3)])).toBeNull();
  expect(unfelt([loss(1, 0.3), loss(1, 0.04)])).toMatchObject({ before: 0.5 });
  expect(unfelt([])).toBeNull();
});

test("the loss at the plunger must be felt as well, if a second device gave it", () => {
  const gave = (drop: number | null, needed: number | null = 0.1) => ({
    push: 4,
    injected: 1e-6,
    seconds: 1,
    loss: drop === null ? null : { before: 1, after: 1 - drop, needed },
  });
  expect(unfelt([], [gave(null), gave(0.5), gave(0.01, null)])).toBeNull();
  expect(unfelt([], [gave(0.04), gave(0.5)])).toBeNull(); // the last time counts
  expect(unfelt([loss(1, 0.06)], [gave(0.04)])).toMatchObject({ before: 1 });
});

test("a goal that is neither met nor missed is not decided", () => {
  expect((["open", "met", "not measured"] as const).map(stateWord)).toEqual(["not decided", "met", "not measured"]);
});

test("a force that rises is no loss of resistance", () => {
  expect(lossText(loss(0, -0.19, null))).toBe("none");
  expect(lossText(loss(0, -0.19))).toBe("none; 0.1 N needed");
  expect(lossText(loss(0, 0.62, null))).toBe("0.62 N");
});
