import { expect, test } from "vitest";
import { type Field, printed, SchemaError, sceneForm } from "../../../src/controls/editor/fields.ts";
import schema from "../support/schema.json";

const form = sceneForm(schema);
const table = (key: string) => form.tables.find((each) => each.key === key)!;
const field = (key: string, name: string): Field => table(key).fields.find((each) => each.key === name)!;

test("the schema of a scene gives its tables in the file's order, the membranes as a list", () => {
  expect(form.fields.map(({ key, kind }) => [key, kind])).toEqual([["name", "text"]]);
  expect(form.tables.map(({ key, list }) => [key, list])).toEqual([
    ["needle", false],
    ["coupling", false],
    ["servo", false],
    ["display", false],
    ["syringe", false],
    ["membrane", true],
  ]);
});

test("a field has its unit, symbol, bounds and help", () => {
  expect(field("membrane", "friction")).toMatchObject({
    title: "Friction",
    symbol: "mu",
    unit: "",
    kind: "number",
    least: { value: 0, open: true },
    most: null,
    required: true,
  });
  expect(field("needle", "tip_angle_deg").most).toEqual({ value: 90, open: true });
  expect(field("membrane", "point_mm").kind).toBe("vector");
  expect(field("servo", "solver").options).toEqual(["paper", "exact"]);
});

test("pairs of which exactly one is given are found, and what the gauges are in mm", () => {
  expect(table("needle").pairs).toEqual([
    ["diameter_mm", "gauge"],
    ["tip_angle_rad", "tip_angle_deg"],
  ]);
  const gauge = field("needle", "gauge");
  expect(gauge.sizes[gauge.options.indexOf(21)]).toBe(0.8);
});

test("a value that is not a schema is refused", () => {
  expect(() => sceneForm(null)).toThrow(SchemaError);
  expect(() => sceneForm({ properties: { x: { type: "boolean" } } })).toThrow("x has a type");
});

test("a number that a word may replace has its bounds and the word", () => {
  const anyOf = [{ type: "number", exclusiveMinimum: 0, maximum: 1 }, { const: "automatic" }];
  const made = sceneForm({
    $defs: { Display: { properties: { force_scale: { title: "Force scale", anyOf, default: 1 } } } },
    properties: { display: { $ref: "#/$defs/Display" } },
  });
  expect(made.tables[0]!.fields[0]).toMatchObject({
    kind: "number",
    least: { value: 0, open: true },
    most: { value: 1, open: false },
    word: "automatic",
    standard: 1,
  });
  expect(field("membrane", "friction").word).toBe("");
});

test("reads a table that a scene may lack", () => {
  const tables = sceneForm(schema).tables;
  expect(tables.find(({ key }) => key === "syringe")).toMatchObject({ optional: true, list: false, title: "Syringe" });
  expect(tables.filter(({ optional }) => optional)).toHaveLength(1);
});

test("a symbol is printed in Greek letters, with its index below", () => {
  expect(printed("kappa")).toEqual({ letter: "κ", index: "" });
  expect(printed("phi_I")).toEqual({ letter: "φ", index: "I" });
  expect(printed("1/T")).toEqual({ letter: "1/T", index: "" });
});
