import { describe, expect, it } from "vitest";
import { stick } from "../../../src/controls/gamepad.ts";

describe("a stick", () => {
  it("is at rest near its middle, fine beside it, and full at its end", () => {
    expect([stick(0), stick(0.1), stick(-0.12), stick(undefined), stick(Number.NaN)].map(Math.abs)).toEqual([
      0, 0, 0, 0, 0,
    ]);
    expect(stick(0.3)).toBeGreaterThan(0);
    expect(stick(0.3)).toBeLessThan(0.1);
    expect(stick(1)).toBe(1);
    expect(stick(-1)).toBe(-1);
    expect(stick(-0.6)).toBeCloseTo(-stick(0.6), 12);
  });
});
