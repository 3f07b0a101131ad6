import { describe, expect, it } from "vitest";
import { drawAxes, Pane } from "../../../src/plots/kit/axes.ts";
import { apart, labelsThatFit, textWidth } from "../../../src/plots/kit/labels.ts";
import { AutoRange, label, niceStep, Scale, ticks } from "../../../src/plots/kit/scale.ts";
import { SvgPen } from "../../../src/plots/kit/svg_pen.ts";
import { CSS_THEME } from "../../../src/plots/kit/theme.ts";

describe("numbers along an axis", () => {
  it("steps are 1, 2 or 5 times a power of ten", () => {
    expect([0.9, 1.9, 4.4, 9, 0.034].map((span) => niceStep(span, 5))).toEqual(
      [0.2, 0.5, 1, 2, 0.005].map((v) => expect.closeTo(v)),
    );
  });
  it("ticks are the multiples of the step that lie inside", () => {
    expect(ticks(-0.3, 0.55, 0.2)).toEqual([-0.2, 0, 0.2, 0.4].map((v) => expect.closeTo(v, 12)));
    expect(ticks(0, 1, 0.5)).toEqual([0, 0.5, 1]);
  });
  it("labels have as many places as the step needs, a minus that is one, and no minus zero", () => {
    expect(label(0.30000000000000004, 0.1)).toBe("0.3");
    expect(label(-0.1, 0.05)).toBe("−0.10");
    expect(label(-1e-17, 0.1)).toBe("0.0");
    expect(label(20, 10)).toBe("20");
  });
});

describe("a calm range", () => {
  it("grows at once and takes in every value", () => {
    const range = new AutoRange();
    range.follow(-0.1, 0.5, 0);
    range.follow(-0.1, 0.9, 0.01);
    expect(range.max).toBeGreaterThanOrEqual(0.9);
    expect(range.min).toBeLessThanOrEqual(-0.1);
  });
  it("does not move while values stay within it", () => {
    const range = new AutoRange();
    range.follow(0, 1, 0);
    const { min, max } = range;
    for (let i = 1; i < 100; i++) expect(range.follow(0, 0.7 + 0.3 * Math.sin(i), i)).toBe(false);
    expect([range.min, range.max]).toEqual([min, max]);
  });
  it("shrinks when values have been much smaller for a while, not before", () => {
    const range = new AutoRange();
    range.follow(0, 10, 0);
    const { max } = range;
    range.follow(0, 1, 1);
    range.follow(0, 1, 2.5);
    expect(range.max).toBe(max);
    range.follow(0, 1, 3.5);
    expect(range.max).toBeLessThan(2);
  });
  it("takes no value that does not exist", () => {
    const range = new AutoRange();
    expect(range.follow(Number.POSITIVE_INFINITY, Number.NEGATIVE_INFINITY, 0)).toBe(false);
    expect(range.follow(Number.NaN, Number.NaN, 0)).toBe(false);
  });
});

it("a scale maps there and back, upside down too", () => {
  const scale = new Scale();
  scale.set(-1, 3, 200, 20);
  expect(scale.px(-1)).toBe(200);
  expect(scale.px(3)).toBe(20);
  expect(scale.value(scale.px(0.7))).toBeCloseTo(0.7, 12);
});

it("a logarithmic scale maps there and back", () => {
  const scale = new Scale();
  scale.set(1e-4, 1e-2, 0, 100, true);
  expect(scale.px(1e-3)).toBeCloseTo(50, 9);
  expect(scale.value(scale.px(3e-4))).toBeCloseTo(3e-4, 12);
});

describe("axes at any width", () => {
  /** The row below a pane: each text's left and right end, px, and the text. */
  function rowBelow(width: number, min: number, max: number): { from: number; to: number; text: string }[][] {
    const pane = new Pane();
    pane.place(44, 20, width - 56, 100);
    pane.rangeX(min, max);
    pane.rangeY(0, 1);
    const pen = new SvgPen();
    drawAxes(pen, pane, CSS_THEME, { x: "time (s)", y: "force (N)" });
    const texts = [
      ...pen.file(width, 160, "none", "", "").matchAll(/<text x="([-\d.]+)" y="([-\d.]+)"[^>]*>([^<]*)</g),
    ];
    const below = texts.filter(([, , y]) => Number(y) > 125);
    const rows = [...new Set(below.map(([, , y]) => y))];
    return rows.map((row) =>
      below
        .filter(([, , y]) => y === row)
        .map(([, x, , text]) => ({
          from: Number(x) - textWidth(text!) / 2,
          to: Number(x) + textWidth(text!) / 2,
          text: text!,
        })),
    );
  }

  it.each([
    [390, 0, 20],
    [390, 123.4, 123.4005],
    [195, -0.05, 0.05],
    [180, 1000, 1080],
    [960, -12, 43],
  ])("%d px wide, from %d to %d: no number touches another, none is replaced by the name", (width, min, max) => {
    const [numbers, name] = rowBelow(width, min, max);
    expect(numbers!.length).toBeGreaterThan(1);
    numbers!.slice(1).forEach(({ from }, i) => {
      expect(from).toBeGreaterThan(numbers![i]!.to);
    });
    expect(numbers!.at(-1)!.to).toBeLessThanOrEqual(width);
    expect(name!.map(({ text }) => text)).toEqual(["time (s)"]);
  });
});

describe("labels in a column", () => {
  it("move apart in their order, up and down, and stay inside", () => {
    expect(apart([50, 10, 12], 12, [0, 100])).toEqual([50, 5, 17]);
    expect(apart([95, 98, 99], 12, [0, 100])).toEqual([76, 88, 100]);
    expect(apart([1, 0], 12, [0, 100])).toEqual([12, 0]);
  });
  it("that have room, or cannot meet, stay where they are", () => {
    expect(apart([5, 40, 80], 12, [0, 100])).toEqual([5, 40, 80]);
    expect(apart([5, 6, 7], 12, [0, 100], (i, j) => i + j !== 1 && i + j !== 3)).toEqual([0, 6, 12]);
  });
});

describe("labels in a row", () => {
  it("of two at one place the heavier one stays", () => {
    const labels = [
      { x: 100, text: "pop −0.12 N", weight: 0.12 },
      { x: 110, text: "pop −0.25 N", weight: 0.25 },
      { x: 300, text: "pop −0.01 N", weight: 0.01 },
    ];
    expect(labelsThatFit(labels, 0, 500)).toEqual([false, true, true]);
  });
  it("none is cut off at an edge", () => {
    const label = { text: "pop −0.12 N", weight: 1 };
    expect(
      labelsThatFit(
        [
          { ...label, x: 40 },
          { ...label, x: 480 },
        ],
        60,
        500,
      ),
    ).toEqual([false, false]);
  });
});
