import { expect, test } from "vitest";
import { type Field, sceneForm } from "../../../src/controls/editor/fields.ts";
import { nudged, numberText, parseNumber } from "../../../src/controls/editor/number.ts";
import { parseNumbers } from "../../../src/controls/editor/numbers_field.ts";
import schema from "../support/schema.json";

test("a point and a comma are both a decimal mark", () => {
  expect(parseNumber("0.45")).toEqual({ value: 0.45 });
  expect(parseNumber(" 0,45 ")).toEqual({ value: 0.45 });
  expect(parseNumber(",5")).toEqual({ value: 0.5 });
  expect(parseNumber("−3e-2")).toEqual({ value: -0.03 });
});

test("anything else gives a message", () => {
  expect(parseNumber("")).toEqual({ wrong: "Enter a number." });
  expect(parseNumber("1,600.5")).toHaveProperty("wrong", expect.stringContaining("more than one point or comma"));
  expect(parseNumber("3,6 N")).toHaveProperty("wrong", "Enter only the number, 3,6, without a unit.");
  expect(parseNumber("thick")).toHaveProperty("wrong", expect.stringContaining("is not a number"));
  expect(parseNumber("0x10")).toHaveProperty("wrong");
  expect(parseNumber("1e999")).toHaveProperty("wrong", expect.stringContaining("too large"));
  expect(parseNumber("1.5", true)).toEqual({ wrong: "Enter a whole number." });
});

test("numbers are written without the noise of a double", () => {
  expect(numberText(0.1 + 0.2)).toBe("0.3");
  expect(numberText(0.0005)).toBe("0.0005");
  expect(numberText(undefined)).toBe("");
});

test("arrow keys move the second digit, the same way up and down", () => {
  expect(nudged(0.45, 1)).toBe(0.46);
  expect(nudged(1, -1)).toBe(0.99);
  expect(nudged(0.99, 1)).toBe(1);
  expect(nudged(-1, 1)).toBe(-0.99);
  expect(nudged(0, 1)).toBe(0.01);
});

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
