import { describe, expect, it } from "vitest";
import { apart, labelsThatFit } from "../../../src/plots/kit/labels.ts";

describe("labels in a column", () => {
  it("move apart in their order, and stay above the lower end", () => {
    expect(apart([50, 10, 12], 12, 100)).toEqual([50, 10, 22]);
    expect(apart([95, 98, 99], 12, 100)).toEqual([76, 88, 100]);
  });
  it("that have room stay where they are", () => {
    expect(apart([5, 40, 80], 12, 100)).toEqual([5, 40, 80]);
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
