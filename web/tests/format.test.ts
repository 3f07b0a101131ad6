import { expect, it } from "vitest";
import { fixedNumber, unbroken } from "../src/format.ts";

it("writes numbers with a minus sign, and a zero without a sign", () => {
  expect(fixedNumber(-1.234, 2)).toBe("−1.23");
  expect(fixedNumber(-0.004, 2)).toBe("0.00");
  expect(fixedNumber(-0, 2)).toBe("0.00");
  expect(fixedNumber(2.5, 0)).toBe("3");
  expect(fixedNumber(undefined, 2)).toBe("–");
  expect(fixedNumber(Number.NaN, 2)).toBe("–");
});

it("breaks no line between a number and its unit", () => {
  expect(unbroken("at least 2 N for 3 s")).toBe("at least 2\u00a0N for 3\u00a0s");
  expect(unbroken("enter 2 small walls")).toBe("enter 2 small walls");
});
