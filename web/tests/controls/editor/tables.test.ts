import { expect, test } from "vitest";
import {
  duplicated,
  freeName,
  getAt,
  moved,
  parsePath,
  pathText,
  replaceKey,
  same,
  setAt,
} from "../../../src/controls/editor/tables.ts";
import { Undo } from "../../../src/controls/editor/undo.ts";
import scene from "../support/scene.json";

const tables = scene.tables as Record<string, unknown>;

test("a path is text and steps", () => {
  expect(parsePath("membrane[1].friction")).toEqual(["membrane", 1, "friction"]);
  expect(pathText(["membrane", 1, "friction"])).toBe("membrane[1].friction");
});

test("a value is put in without changing what was", () => {
  const path = parsePath("membrane[1].friction");
  const next = setAt(tables, path, 0.5);
  expect(getAt(next, path)).toBe(0.5);
  expect(getAt(tables, path)).toBe(0.08);
  expect(getAt(next, ["membrane", 0])).toBe(getAt(tables, ["membrane", 0]));
});

test("missing tables are created, and undefined removes a key", () => {
  expect(setAt({}, ["servo", "solver"], "paper")).toEqual({ servo: { solver: "paper" } });
  expect(setAt({ servo: { solver: "paper" } }, ["servo", "solver"], undefined)).toEqual({ servo: {} });
});

test("one key takes another's place", () => {
  expect(Object.keys(replaceKey({ gauge: 21, tip: 1 }, "gauge", "diameter_mm", 0.8))).toEqual(["diameter_mm", "tip"]);
});

test("membranes move, and stop at the ends", () => {
  expect(moved(["a", "b", "c"], 0, 1)).toEqual(["b", "a", "c"]);
  expect(moved(["a", "b", "c"], 0, -1)).toEqual(["a", "b", "c"]);
  expect(moved(["a", "b", "c"], 2, 9)).toEqual(["a", "b", "c"]);
});

test("a copy lies behind its membrane, under a name of its own", () => {
  const [, copy] = duplicated(tables.membrane as Record<string, unknown>[], 0);
  expect(copy).toMatchObject({ name: "skin 2", point_mm: [0, -3.2, 0], friction: 0.1 });
  expect(freeName("skin 2", new Set(["skin 2", "skin 3"]))).toBe("skin 4");
});

test("values are equal whatever the order of their keys", () => {
  expect(same({ a: [1, { b: 2 }], c: 3 }, { c: 3, a: [1, { b: 2 }] })).toBe(true);
  expect(same({ a: 1 }, { a: 1, b: 2 })).toBe(false);
  expect(same([1, 2], { 0: 1, 1: 2 })).toBe(false);
});

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
