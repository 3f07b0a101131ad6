import { expect, test } from "vitest";
import {
  changed,
  type Draft,
  draftOf,
  fieldOf,
  goalFields,
  nameOf,
  tablesOf,
} from "../../../../src/controls/exercises/maker/draft.ts";
import type { SceneOutline } from "../../../../src/wire/messages.ts";

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

const table = (kind: string, properties: Record<string, object>, syringe = false) => ({
  properties: { kind: { const: kind }, ...properties },
  "x-syringe": syringe,
});
const whole_tip = { type: "boolean" };
const FIELDS = goalFields({
  properties: { goal: { items: { oneOf: ["A", "B", "C", "D", "E"].map((name) => ({ $ref: `#/$defs/${name}` })) } } },
  $defs: {
    A: table("reach", { whole_tip }),
    B: table("stay", { seconds: { type: "number", "x-label": "Stay, s" }, whole_tip }),
    C: table("never_pass", { membrane: { type: "string", "x-label": "Never pass" }, whole_tip }),
    D: table("stop_after_pop", { membrane: { type: "string" }, within_mm: { anyOf: [], "x-label": "Stop, mm" } }),
    E: table("feel_plunger", { at_least_N: { type: "number", "x-label": "Push, N" } }, true),
  },
});
const made = (draft: Partial<Draft>) => tablesOf({ ...draftOf(SCENE), ...draft }, SCENE, FIELDS);

test("each goal whose schema has a label has a field, and its table has what the schema wants", () => {
  expect(FIELDS.map(({ kind, label, membrane, needsSyringe }) => [kind, label, membrane, needsSyringe])).toEqual([
    ["stay", "Stay, s", false, false],
    ["never_pass", "Never pass", true, false],
    ["stop_after_pop", "Stop, mm", false, false],
    ["feel_plunger", "Push, N", false, true],
  ]);
  const tables = made({ goals: { stay: 2, feel_plunger: 1.5 }, wholeTip: true });
  expect(tables.goal).toEqual([
    { kind: "stay", seconds: 2, whole_tip: true },
    { kind: "feel_plunger", at_least_N: 1.5 },
  ]);
  expect(fieldOf("goal[1].at_least_N", tables)).toBe("goal.feel_plunger");
});

test("a new exercise asks for the space between the last two membranes", () => {
  const draft = draftOf(SCENE);
  expect([draft.behind, draft.from, draft.to]).toEqual(["front", 0, 3]);
});

test("where the next layer touches the membrane, the space is that layer", () => {
  const membranes = [membrane("skin", 0, 1.2e-3), membrane("fat", 1.2e-3, 6e-3), membrane("muscle", 7.2e-3, 9e-3)];
  const draft = draftOf({ ...SCENE, membranes } as unknown as SceneOutline, "skin");
  expect([draft.space, draft.to]).toEqual(["the fat", 6]);
});

test("what the teacher has not edited follows the membrane of the goal", () => {
  const first = draftOf(SCENE);
  const skin = changed(first, { behind: "skin" }, SCENE, new Set());
  expect(skin.instruction).toBe("Push in until the skin gives way, and stop.");
  expect([skin.space, skin.to]).toEqual(["the space behind the skin", 3.6]);
  const own = { ...first, instruction: "Slowly!", goals: { stay: 9 } };
  const kept = changed(own, { behind: "skin" }, SCENE, new Set(["instruction"]));
  expect([kept.instruction, kept.space, kept.goals]).toEqual(["Slowly!", "the space behind the skin", { stay: 9 }]);
});

test("the task's sentence follows angle, depth and plunger until the teacher edits it", () => {
  const none = new Set<never>();
  const slanted = changed(draftOf(SCENE), { angle: 45, from: 2 }, SCENE, none);
  expect(slanted.instruction).toBe("Push in at 45 degrees until the front gives way, go on for 2 mm, and stop.");
  for (const goal of ["feel_plunger", "stop_plunger"]) {
    const thumb = changed(draftOf(SCENE), { goals: { [goal]: 2 } }, SCENE, none);
    expect(thumb.instruction).toBe("Push in and push the plunger until it gives way behind the front, and stop.");
  }
  const own = changed(slanted, { instruction: "Slowly!" }, SCENE, new Set(["instruction"]));
  expect(changed(own, { angle: 30 }, SCENE, new Set(["instruction"])).instruction).toBe("Slowly!");
});

test("a needle for a vessel is slanted, and its whole tip must be inside", () => {
  const membranes = SCENE.membranes.map((one) => ({ ...one, behind: one.name === "front" ? "blood" : "fat" }));
  const vein = { ...SCENE, membranes } as SceneOutline;
  expect(draftOf(vein)).toMatchObject({ angle: 30, wholeTip: true, space: "the vessel" });
  expect(draftOf(vein).instruction).toBe("Push in at 30 degrees until the front gives way, and stop.");
  expect(changed(draftOf(vein), { behind: "skin" }, vein, new Set())).toMatchObject({ angle: 30, wholeTip: false });
  expect(draftOf(SCENE).angle).toBe(90);
});

test("the tables have only the goals that are asked for", () => {
  expect(made({ goals: { stop_after_pop: 2.5, never_pass: "back" } })).toMatchObject({
    scene: "venipuncture",
    space: { behind: "front", depth_mm: 0, deepest_mm: 3 },
    goal: [
      { kind: "reach" },
      { kind: "never_pass", membrane: "back" },
      { kind: "stop_after_pop", membrane: "front", within_mm: 2.5 },
    ],
  });
});

test("a slanted needle starts where it points at the middle of the goal", () => {
  const start = (angle: number) => (made({ angle }) as { start: { position_mm: number[] } }).start.position_mm;
  expect(start(90)).toEqual([0, 5, 0]);
  expect(start(45)).toEqual([-11.7, 5, 0]); // 5 mm above the skin, 6.71 mm below it
});

test("a problem of the file is shown at its field", () => {
  const tables = made({});
  expect(fieldOf("goal[0].seconds", tables)).toBe("goal.stay");
  expect(fieldOf("goal[0].whole_tip", made({ goals: {} }))).toBe("wholeTip");
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
