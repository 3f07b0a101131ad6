import { expect, test } from "vitest";
import { sceneForm } from "../../../src/controls/editor/fields.ts";
import { converted } from "../../../src/controls/editor/pair_field.ts";
import schema from "../support/schema.json";

const needle = sceneForm(schema).tables[0]!;
const field = (key: string) => needle.fields.find((each) => each.key === key)!;

test("an angle goes to degrees and back", () => {
  expect(converted(field("tip_angle_rad"), field("tip_angle_deg"), 0.28)).toBe(16.043);
  expect(converted(field("tip_angle_deg"), field("tip_angle_rad"), 11)).toBe(0.19199);
});

test("a gauge is its diameter, and a diameter the nearest gauge", () => {
  expect(converted(field("gauge"), field("diameter_mm"), 21)).toBe(0.8);
  expect(converted(field("diameter_mm"), field("gauge"), 1.08)).toBe(19);
  expect(converted(field("diameter_mm"), field("gauge"), "wide")).toBeUndefined();
});
