import { expect, test } from "vitest";
import { bandPath, curvePath, extentFor, placing, ticksOf } from "../../../src/controls/editor/law_shape.ts";
import scene from "../support/scene.json";

const law = scene.laws[0]!;

test("the axes hold the whole law, and stay while it fills a fair part of them", () => {
  const extent = extentFor(law, null);
  expect(extent.most).toBeGreaterThanOrEqual(Math.max(...law.upper));
  expect(extent.least).toBeLessThanOrEqual(Math.min(...law.lower));
  expect(extent.depth).toBeGreaterThan(law.through);
  const less = { ...law, upper: law.upper.map((f) => f * 0.7), lower: law.lower.map((f) => f * 0.7) };
  expect(extentFor(less, extent)).toEqual(extent);
  const more = { ...law, upper: law.upper.map((f) => f * 3) };
  expect(extentFor(more, extent).most).toBeGreaterThan(extent.most);
});

test("a curve goes on along its last force, and the band is closed", () => {
  const place = placing({ depth: 0.01, least: -1, most: 1 }, 0, 0, 100, 100);
  expect(curvePath([0, 0.005], [0, 1], place, 0.01)).toBe("M0.0,50.0L50.0,0.0L100.0,0.0");
  expect(bandPath({ ...law, depth: [0, 0.005], upper: [0, 1], lower: [0, -1] }, place, 0.01)).toBe(
    "M0.0,50.0L50.0,0.0L100.0,0.0L100.0,100.0L50.0,100.0L0.0,50.0Z",
  );
});

test("ticks are round numbers within the axis", () => {
  expect(ticksOf(0, 0.01)).toEqual([0, 0.002, 0.004, 0.006, 0.008, 0.01]);
  expect(ticksOf(-0.5, 0.3)).toEqual([-0.4, -0.2, 0, 0.2]);
});
