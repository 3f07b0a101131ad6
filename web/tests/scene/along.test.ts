import { expect, it } from "vitest";
import { alongNeedle } from "../../src/scene/along.ts";

const MM_PER_PIXEL = 0.1;

it("a drag along the needle moves it as far as the pointer", () => {
  // The needle lies in the picture's plane, at 30 degrees: 1 mm is 10 pixels.
  const inward = [10 * Math.cos(Math.PI / 6), 10 * Math.sin(Math.PI / 6)] as const;
  expect(alongNeedle([86.6, 50], inward, MM_PER_PIXEL)).toBeCloseTo(10, 3);
  expect(alongNeedle([-86.6, -50], inward, MM_PER_PIXEL)).toBeCloseTo(-10, 3);
});

it("a drag straight down also goes in, and a drag across the needle does nothing", () => {
  const inward = [10 * Math.cos(Math.PI / 6), 10 * Math.sin(Math.PI / 6)] as const;
  expect(alongNeedle([0, 100], inward, MM_PER_PIXEL)).toBeCloseTo(5, 3);
  expect(alongNeedle([50, -86.6], inward, MM_PER_PIXEL)).toBeCloseTo(0, 3);
});

it("a needle that looks shorter, because it points away from the camera, moves by more for the same drag", () => {
  expect(alongNeedle([0, 50], [0, 5], MM_PER_PIXEL)).toBeCloseTo(10, 6);
});

it("where the camera looks along the needle, down is inward at the scale of the picture", () => {
  expect(alongNeedle([30, 50], [0.5, -1], MM_PER_PIXEL)).toBeCloseTo(5, 6);
});
