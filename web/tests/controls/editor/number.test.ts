import { expect, test } from "vitest";
import { nudged, numberText, parseNumber } from "../../../src/controls/editor/number.ts";

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
