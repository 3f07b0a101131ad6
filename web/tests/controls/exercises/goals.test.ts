import { expect, test } from "vitest";
import { stateWord, verdict } from "../../../src/controls/exercises/goals.ts";

const goals = (...states: ("met" | "missed" | "not measured")[]) => states.map((state) => ({ text: "a goal", state }));

test("a pass with a goal that was not measured says so", () => {
  expect(verdict({ passed: true, goals: goals("met", "met") })).toBe("✓ passed");
  expect(verdict({ passed: true, goals: goals("met", "not measured") })).toBe(
    "✓ passed, but not everything was measured",
  );
  expect(verdict({ passed: false, goals: goals("missed", "not measured") })).toBe("✕ not passed");
});

test("a goal that is neither met nor missed is not decided", () => {
  expect((["open", "met", "not measured"] as const).map(stateWord)).toEqual(["not decided", "met", "not measured"]);
});
