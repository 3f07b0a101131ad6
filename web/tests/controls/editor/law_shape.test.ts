import { expect, test } from "vitest";
import { LawShape } from "../../../src/controls/editor/law_shape.ts";
import { SvgPen } from "../../../src/plots/kit/svg_pen.ts";
import { CSS_THEME } from "../../../src/plots/kit/theme.ts";
import type { LawCurve } from "../../../src/wire/messages.ts";
import scene from "../support/scene.json";

const law: LawCurve = scene.laws[0]!;
const scaled = (factor: number): LawCurve => ({
  ...law,
  upper: law.upper.map((force) => force * factor),
  lower: law.lower.map((force) => force * factor),
});

function drawn(shape: LawShape, now: LawCurve, before: LawCurve | null = null): string {
  const pen = new SvgPen();
  shape.draw(pen, now, before, 330, 166, CSS_THEME);
  return pen.file(330, 166, "none", "", "");
}

test("the axes hold the whole law, and stay while it fills a fair part of them", () => {
  const shape = new LawShape();
  shape.fit(law, 0);
  drawn(shape, law);
  const { min, max } = shape.pane.y;
  expect(max).toBeGreaterThanOrEqual(-Math.min(...law.lower));
  expect(min).toBeLessThanOrEqual(-Math.max(...law.upper));
  expect(shape.pane.x.max).toBeGreaterThan(law.through * 1e3);
  shape.fit(scaled(0.8), 1);
  drawn(shape, scaled(0.8));
  expect([shape.pane.y.min, shape.pane.y.max]).toEqual([min, max]);
  shape.fit(scaled(3), 2);
  drawn(shape, scaled(3));
  expect(shape.pane.y.max).toBeGreaterThan(max);
});

test("insertion friction is above: the hand feels the opposite of the needle's force", () => {
  const shape = new LawShape();
  shape.fit(law, 0);
  const file = drawn(shape, law, scaled(0.5));
  const highest = shape.pane.y.px(-Math.min(...law.lower));
  const line = /<path d="([^"]*)" fill="none" stroke="var\(--data-1\)" stroke-width="2"/.exec(file)![1]!;
  const heights = [...line.matchAll(/[ML][-\d.]+ ([-\d.]+)/g)].map(([, y]) => Number(y));
  expect(Math.min(...heights)).toBeCloseTo(highest, 1);
  expect(highest).toBeLessThan(shape.pane.y.px(0));
  expect(file.match(/stroke-dasharray="3 3"/g)).toHaveLength(2);
});
