import { expect, test } from "vitest";
import { lossText, stateWord, verdict } from "../../../src/controls/exercises/goals.ts";

const goals = (...states: ("met" | "missed" | "not measured")[]) => states.map((state) => ({ text: "a goal", state }));

const loss = (drop: number, needed: number | null = 0.1) => ({ before: 0.5, after: 0.5 - drop, needed });

test("a pass of an earlier version with a goal that was not measured says so", () => {
  expect(verdict({ passed: true, withheld: "", goals: goals("met", "met") })).toBe("✓ passed");
  expect(verdict({ passed: true, withheld: "", goals: goals("met", "not measured") })).toBe(
    "✓ passed, but not everything was measured",
  );
  expect(verdict({ passed: false, withheld: "", goals: goals("missed", "not measured") })).toBe("✕ not passed");
});

test("a verdict that is withheld says why", () => {
  expect(verdict({ passed: false, withheld: "the force was off", goals: goals("met", "met") })).toBe(
    "◐ not judged as passed: the force was off",
  );
});

test("a goal that is neither met nor missed is not decided", () => {
  expect((["open", "met", "not measured"] as const).map(stateWord)).toEqual(["not decided", "met", "not measured"]);
});

test("a force that rises is no loss of resistance", () => {
  expect(lossText(loss(-0.19, null))).toBe("none");
  expect(lossText(loss(-0.19))).toBe("none; 0.1 N needed");
  expect(lossText(loss(0.62, null))).toBe("0.62 N");
});
