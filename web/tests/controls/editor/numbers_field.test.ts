import { expect, test } from "vitest";
import { type Field, sceneForm } from "../../../src/controls/editor/fields.ts";
import { parseNumbers } from "../../../src/controls/editor/numbers_field.ts";
import schema from "../support/schema.json";

const form = sceneForm(schema);
const field = (table: string, key: string): Field =>
  form.tables.find((each) => each.key === table)!.fields.find((each) => each.key === key)!;

test("a list of numbers is read with spaces, semicolons and decimal commas", () => {
  expect(parseNumbers("0; 0.5 1,5;  -2e-1")).toEqual({ values: [0, 0.5, 1.5, -0.2] });
  expect(parseNumbers("  ")).toEqual({ values: [] });
  expect(parseNumbers("0, 0.5, 1")).toEqual({ values: [0, 0.5, 1] });
});

test("what is wrong with a list is said, with what separates its numbers", () => {
  const found = parseNumbers("0; wide");
  expect("wrong" in found && found.wrong).toMatch(/“wide” is not a number.*semicolon/);
});

test("a profile is a list of numbers in the folded part of a membrane, a point is a vector", () => {
  expect(field("membrane", "profile_depth_mm")).toMatchObject({
    kind: "numbers",
    unit: "mm",
    folded: "Measured tissue",
  });
  expect(field("membrane", "cutting_N")).toMatchObject({ kind: "number", folded: "Measured tissue" });
  expect(field("coupling", "relaxation_time_constant_s")).toMatchObject({ kind: "numbers", folded: "" });
  expect(field("membrane", "point_mm").kind).toBe("vector");
});
