import { expect, test } from "vitest";
import { clockText, heldShare, showGoal } from "../../../src/controls/exercises/task.ts";
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
