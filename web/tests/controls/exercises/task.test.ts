import { expect, it, test } from "vitest";
import { lossText, stateWord, verdict } from "../../../src/controls/exercises/goals.ts";
import { clockText, heldShare, lostWords, showGoal } from "../../../src/controls/exercises/task.ts";
import { titleAmong } from "../../../src/controls/exercises/title.ts";
import { App } from "../../../src/state/app.ts";
import type { ExerciseOverview, ExerciseStatus, SceneView } from "../../../src/wire/messages.ts";
import { FakeEngine } from "../support/fake_engine.ts";

const membrane = (name: string, depth: number, thickness: number) => ({
  name,
  point: [0, -depth, 0],
  inward_normal: [0, -1, 0],
  thickness,
});
const scene = { membranes: [membrane("skin", 0, 0.0012), membrane("wall", 0.005, 0.0004)] } as unknown as SceneView;
const exercise = { name: "mine", space_name: "the gap", space: [0, 1], space_to: null, goal_from: 0.001, line: null };
const running = (more: Partial<ExerciseStatus> = {}): ExerciseStatus => ({
  kind: "exercise",
  exercise: "mine",
  running: true,
  instruction: "",
  goals: [],
  result: "",
  blind: false,
  held: 0,
  hold: 0,
  time: 0,
  time_limit: null,
  ...more,
});

test("the clock shows whole seconds, and the limit if there is one", () => {
  expect(clockText({ time: 12.9, time_limit: 60 })).toBe("12 s of 60 s");
  expect(clockText({ time: 0, time_limit: null })).toBe("0 s");
});

test("the ring fills with the time held, and is empty without a goal to stay", () => {
  expect(heldShare({ held: 1.5, hold: 3 })).toBe(0.5);
  expect(heldShare({ held: 5, hold: 3 })).toBe(1);
  expect(heldShare({ held: 5, hold: 0 })).toBe(0);
});

test("the view gets the goal of the running exercise, and none of a blind one", () => {
  const app = new App(new FakeEngine(scene));
  app.live.scene.value = scene;
  const of = (name: string) => (name === "mine" ? (exercise as unknown as ExerciseOverview) : null);
  showGoal(app, of);
  expect(app.goal.value).toBeNull();
  app.exercise.value = running();
  showGoal(app, of);
  expect(app.goal.value).toMatchObject({ name: "the gap", line: null });
  expect(app.goal.value?.top).toBeCloseTo(0.0022, 9);
  expect(app.goal.value?.bottom).toBeCloseTo(0.005, 9);
  const before = app.goal.value;
  showGoal(app, of);
  expect(app.goal.value).toBe(before); // no new picture ten times a second
  app.exercise.value = running({ blind: true });
  showGoal(app, of);
  expect(app.goal.value).toBeNull();
});

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

const known = [
  { name: "venipuncture", title: "Venipuncture" },
  { name: "mine", title: "Venipuncture" },
  { name: "epidural", title: "Epidural" },
];

it("adds the name where two exercises have one title, and nowhere else", () => {
  expect(known.map((one) => titleAmong(one, known))).toEqual([
    "Venipuncture (venipuncture)",
    "Venipuncture (mine)",
    "Epidural",
  ]);
});

it("tells the results of a removed exercise from those of one that is there", () => {
  expect(titleAmong({ name: "gone", title: "Epidural" }, known)).toBe("Epidural (gone)");
});

it("an attempt that a new studio does not know is told as lost, and an attempt that ended is not", () => {
  const ended = running({ running: false });
  const idle = { ...ended, exercise: "" };
  expect(lostWords(running(), idle, "Mine")).toContain("the attempt is lost: Mine. To begin again, press Start");
  for (const [before, now] of [
    [running(), ended],
    [ended, idle],
    [null, idle],
  ] as const)
    expect(lostWords(before, now, "Mine")).toBeNull();
});
