import { expect, test } from "vitest";
import { judgedBy } from "../../../src/controls/exercises/expert.ts";
import { tracePath } from "../../../src/controls/exercises/result_dialog.ts";
import { indexAt, layersOf, spaceOf, traceOf } from "../../../src/controls/exercises/trace.ts";
import { endWord } from "../../../src/controls/exercises/trace_drawing.ts";
import type { SceneView } from "../../../src/wire/messages.ts";
import json from "../support/scene.json";

const { membranes } = json as unknown as SceneView;

test("a trace is the server's decimated curves; null is a gap", () => {
  const { time, depth, force } = traceOf({
    time: [1, 2, 3],
    depth: [0.1, null, 0.2],
    force: [5, null, 6],
    tip: 0,
    membranes,
  });
  expect([[...time], [...depth], [...force]]).toEqual([
    [1, 2, 3],
    [0.1, Number.NaN, 0.2],
    [5, Number.NaN, 6],
  ]);
});

test("the thinned trace is asked for, not all ticks, from a little before the first touch on", () => {
  const touch = { what: "touch", time: 3.25 } as never;
  expect(tracePath({ recording: "a b", events: [touch] })).toBe("/api/recordings/a%20b/trace?from=2.750");
  expect(tracePath({ recording: "x", events: [] })).toBe("/api/recordings/x/trace?from=0.000");
});

test("the drawing ends with the word of the verdict", () => {
  const [kept, missed] = [{ text: "", state: "not measured" } as const, { text: "", state: "missed" } as const];
  expect(endWord({ passed: true, withheld: "", goals: [] })).toBe("✓ done");
  expect(endWord({ passed: false, withheld: "not everything was measured", goals: [kept] })).toBe("◐ not judged");
  expect(endWord({ passed: false, withheld: "", goals: [missed] })).toBe("✕ missed");
  expect(endWord({ passed: false, withheld: "", goals: [kept] })).toBe("ended");
});

test("the depth of an exercise is asked for as it is judged", () => {
  expect([judgedBy({ space: [1, 2] }), judgedBy({ space: [] }), judgedBy(null)]).toEqual(["&before=1", "", ""]);
});

test("layers are measured from the first surface, and the space lies between two of them", () => {
  const layers = layersOf(membranes);
  expect(layers.map(({ name }) => name)).toEqual(["skin", "front vein wall", "back vein wall"]);
  const space = spaceOf(layers, { space: [1, 2], goal_from: 0, space_to: null });
  expect(space?.top).toBeCloseTo(5.21e-3, 9);
  expect(space?.bottom).toBeCloseTo(8.22e-3, 9);
  expect(spaceOf(layers, { space: [], goal_from: 0, space_to: null })).toBeNull();
});

test("a space behind one membrane begins and ends at a depth, or nowhere", () => {
  const layers = layersOf(membranes);
  const deep = spaceOf(layers, { space: [1], goal_from: 1e-3, space_to: 2e-3 });
  expect(deep?.top).toBeCloseTo(6.21e-3, 9);
  expect(deep?.bottom).toBeCloseTo(7.21e-3, 9);
  expect(spaceOf(layers, { space: [1], goal_from: 0, space_to: null })?.bottom).toBe(Number.POSITIVE_INFINITY);
});

test("what is to be reached begins at the depth of the reach goal, not where the space begins", () => {
  const layers = layersOf(membranes);
  const exercise = { space: [1, 2], space_from: 0.5e-3, space_to: null, goal_from: 2e-3 };
  expect(spaceOf(layers, exercise)?.top).toBeCloseTo(7.21e-3, 9);
  expect(spaceOf(layers, exercise)?.bottom).toBeCloseTo(8.22e-3, 9);
});

test("a time is found among ticks", () => {
  expect([-1, 0, 1.5, 9].map((when) => indexAt([0, 1, 2, 3], when))).toEqual([0, 0, 2, 4]);
});
