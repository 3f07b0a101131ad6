import { expect, test } from "vitest";
import { envelope, indexAt, layersOf, spaceBetween, traceOf } from "../../../src/controls/exercises/trace.ts";
import { Source } from "../../../src/state/source.ts";
import type { SceneView } from "../../../src/wire/messages.ts";
import { decodeTicks } from "../../../src/wire/ticks.ts";
import { expected, makeFrame } from "../../wire/frame.ts";
import json from "../support/scene.json";

const scene = json as unknown as SceneView;

test("an attempt is the tip's depth below the first surface and the force on the hand", () => {
  const source = new Source("x", false, 10);
  source.scene.value = scene; // its surface is the plane y = 0, inward is down
  source.history.push(decodeTicks(makeFrame({ first: 5, count: 3, membranes: 3 })));
  const { time, depth, force } = traceOf(source);
  expect([...time]).toEqual([5, 6, 7].map((tick) => expect.closeTo(tick / 1600, 6)));
  expect(depth[1]).toBeCloseTo(-expected("tip", 6, 1), 5);
  const dot = [0, 1, 2].reduce((sum, i) => sum + expected("model_force", 6, i) * expected("axis", 6, i), 0);
  expect(force[1]! / -dot).toBeCloseTo(1, 5);
});

test("layers are measured from the first surface, and the space lies between two of them", () => {
  const layers = layersOf(scene);
  expect(layers.map(({ name }) => name)).toEqual(["skin", "front vein wall", "back vein wall"]);
  const space = spaceBetween(layers, [1, 2]);
  expect(space?.top).toBeCloseTo(5.21e-3, 9);
  expect(space?.bottom).toBeCloseTo(8.22e-3, 9);
  expect(spaceBetween(layers, [])).toBeNull();
});

test("an envelope keeps every column's extremes, in few points", () => {
  const x = Float64Array.from({ length: 10_000 }, (_, i) => i);
  const y = Float32Array.from(x, (i) => (i === 4321 ? 100 : Math.sin(i)));
  const [piece, more] = envelope(x, y, 0, x.length, 100);
  expect(more).toBeUndefined();
  expect(piece!.length / 2).toBeLessThanOrEqual(400);
  expect(Math.max(...piece!.filter((_, i) => i % 2))).toBe(100);
  const times = piece!.filter((_, i) => i % 2 === 0);
  expect(times.every((value, i) => i === 0 || value > times[i - 1]!)).toBe(true);
});

test("a gap breaks the curve", () => {
  const y = Float32Array.from([1, 2, Number.NaN, Number.NaN, 3, 4]);
  expect(envelope([0, 1, 2, 3, 4, 5], y, 0, 6, 6)).toEqual([
    [0, 1, 1, 2],
    [4, 3, 5, 4],
  ]);
});

test("a time is found among ticks", () => {
  expect([-1, 0, 1.5, 9].map((when) => indexAt([0, 1, 2, 3], when))).toEqual([0, 0, 2, 4]);
});
