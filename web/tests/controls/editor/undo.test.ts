import { expect, test } from "vitest";
import { Undo } from "../../../src/controls/editor/undo.ts";

test("steps of one drag are one step to undo", () => {
  const undo = new Undo(0);
  expect(undo.step(1, "friction", 0)).toBe(true);
  expect(undo.step(2, "friction", 100)).toBe(false);
  undo.step(3, "thickness", 150);
  undo.step(4, "thickness", 5000);
  expect([undo.undo(), undo.undo(), undo.undo()]).toEqual([3, 2, 0]);
  expect(undo.canUndo).toBe(false);
  expect([undo.redo(), undo.redo(), undo.redo()]).toEqual([2, 3, 4]);
});

test("a new step clears the redo history", () => {
  const undo = new Undo("a");
  undo.step("b", "", 0);
  undo.undo();
  undo.step("c", "", 1);
  expect(undo.canRedo).toBe(false);
  expect(undo.undo()).toBe("a");
});
