import { describe, expect, it } from "vitest";
import { labelsThatFit } from "../../src/plots/marks.ts";

describe("labels of pops", () => {
  it("of two at one place the greater pop keeps its label", () => {
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
