import { expect, it } from "vitest";
import { fixedNumber } from "../src/format.ts";

it("writes numbers with a minus sign, and a zero without a sign", () => {
  expect(fixedNumber(-1.234, 2)).toBe("−1.23");
  expect(fixedNumber(-0.004, 2)).toBe("0.00");
  expect(fixedNumber(-0, 2)).toBe("0.00");
  expect(fixedNumber(2.5, 0)).toBe("3");
  expect(fixedNumber(undefined, 2)).toBe("–");
  expect(fixedNumber(Number.NaN, 2)).toBe("–");
});
