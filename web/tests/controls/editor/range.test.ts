import { expect, test } from "vitest";
import { type Field, sceneForm } from "../../../src/controls/editor/fields.ts";
import { niceAbove, placeOf, rangeAround, SLIDER_STEPS, valueAt } from "../../../src/controls/editor/range.ts";
import schema from "../support/schema.json";

const form = sceneForm(schema);
const field = (table: string, key: string): Field =>
  form.tables.find((each) => each.key === table)!.fields.find((each) => each.key === key)!;

test("a number that must be positive slides over two decades around it", () => {
  expect(rangeAround(field("membrane", "friction"), 0.1)).toEqual({ low: 0.01, high: 1, scale: "log" });
});

test("a number that may be 0 slides from 0, finest there", () => {
  const thickness = field("membrane", "thickness_mm");
  const range = rangeAround(thickness, 1.2);
  expect(range).toEqual({ low: 0, high: 5, scale: "square" });
  expect(valueAt(range, 0, thickness)).toBe(0);
  expect(rangeAround(thickness, 0).high).toBe(2);
});

test("between finite bounds the slider spans them and stays off those that are open", () => {
  const angle = field("needle", "tip_angle_deg");
  const range = rangeAround(angle, 11);
  expect(range).toEqual({ low: 0, high: 90, scale: "linear" });
  expect(valueAt(range, 0, angle)).toBeGreaterThan(0);
  expect(valueAt(range, SLIDER_STEPS, angle)).toBeLessThan(90);
});

test("a value's place gives the value again, to the slider's step", () => {
  for (const [key, value] of [
    ["friction", 0.237],
    ["thickness_mm", 0.4],
    ["precompression_N", 0.25],
  ] as const) {
    const each = field("membrane", key);
    const range = rangeAround(each, value);
    expect(Math.abs(valueAt(range, placeOf(range, value), each) / value - 1)).toBeLessThan(0.02);
  }
});

test("nice numbers above", () => {
  expect([0.0017, 1, 4.8, 5.01, 99].map(niceAbove)).toEqual([0.002, 1, 5, 10, 100]);
});
