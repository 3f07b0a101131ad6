import { expect, test } from "vitest";
import {
  draftOf,
  fieldOf,
  nameOf,
  type SceneOutline,
  tablesOf,
} from "../../../../src/controls/exercises/maker/draft.ts";

const membrane = (name: string, depth: number, thickness: number) => ({
  name,
  point: [0, -depth, 0],
  inward_normal: [0, -1, 0],
  thickness,
  look: "skin",
  behind: "fat",
});
const SCENE = {
  name: "venipuncture",
  title: "Venipuncture",
  tip_length: 4.1e-3,
  syringe: false,
  membranes: [membrane("skin", 0, 1.2e-3), membrane("front", 4.81e-3, 0.4e-3), membrane("back", 8.22e-3, 0.4e-3)],
} as unknown as SceneOutline;

test("a new exercise asks for the space between the last two membranes", () => {
  const draft = draftOf(SCENE);
  expect([draft.behind, draft.from, draft.to]).toEqual(["front", 0, 3]);
});

test("the tables have only the goals that are asked for", () => {
  const draft = { ...draftOf(SCENE), stay: null, stopWithin: 2.5, entries: null, seconds: null, neverPass: "back" };
  expect(tablesOf(draft, SCENE)).toMatchObject({
    scene: "venipuncture",
    space: { behind: "front", depth_mm: 0, deepest_mm: 3 },
    goal: [
      { kind: "reach" },
      { kind: "stop_after_pop", membrane: "front", within_mm: 2.5 },
      { kind: "never_pass", membrane: "back" },
    ],
  });
});

test("the plunger's goals have their own fields", () => {
  const tables = tablesOf({ ...draftOf(SCENE), stay: null, entries: null, seconds: null, push: 2, inject: 1.5 }, SCENE);
  expect(tables.goal).toEqual([
    { kind: "reach" },
    { kind: "feel_plunger", at_least_N: 2 },
    { kind: "stop_plunger", within_mL: 1.5 },
  ]);
  expect(fieldOf("goal[1].at_least_N", tables)).toBe("push");
  expect(fieldOf("goal[2].within_mL", tables)).toBe("inject");
});

test("how the needle is moved has its own fields", () => {
  const asked = { angleWithin: 5, speed: 30, pause: 1, depth: 12 };
  const tables = tablesOf({ ...draftOf(SCENE), stay: null, entries: null, seconds: null, ...asked }, SCENE);
  expect(tables.goal).toEqual([
    { kind: "reach" },
    { kind: "entry_angle", within_deg: 5 },
    { kind: "speed", at_most_mm_per_s: 30 },
    { kind: "no_pause", seconds: 1 },
    { kind: "depth", at_most_mm: 12 },
  ]);
  expect([1, 2, 3, 4].map((i) => fieldOf(`goal[${i}].any`, tables))).toEqual(Object.keys(asked));
});

test("a slanted needle starts where it points at the middle of the goal", () => {
  const start = (angle: number) =>
    (tablesOf({ ...draftOf(SCENE), angle }, SCENE) as { start: { position_mm: number[] } }).start.position_mm;
  expect(start(90)).toEqual([0, 5, 0]);
  expect(start(45)).toEqual([-11.7, 5, 0]); // 5 mm above the skin, 6.71 mm below it
});

test("a problem of the file is shown at its field", () => {
  const tables = tablesOf(draftOf(SCENE), SCENE);
  expect(fieldOf("goal[0].seconds", tables)).toBe("stay");
  expect(fieldOf("goal[1].at_most", tables)).toBe("entries");
  expect(fieldOf("space.deepest_mm", tables)).toBe("to");
  expect(fieldOf("space.press_mm", tables)).toBe("");
});

test("a title becomes the name of a file", () => {
  expect(nameOf("  Übung: 3 mm / rückwärts! ")).toBe("ubung-3-mm-ruckwarts");
  expect(nameOf("静脉 穿刺 2")).toBe("静脉-穿刺-2");
  expect(nameOf("Игла")).toBe("игла");
  expect(nameOf("바늘")).toBe("바늘"); // composed, as the studio compares names
  expect(nameOf("सुई")).toBe("सुई");
  expect(nameOf("?!")).toBe("exercise");
});
