import { describe, expect, it } from "vitest";
import { roundLength } from "../../src/scene/scale_bar.ts";

describe("the scale bar", () => {
  it("has a round length, and is between 60 and 150 pixels long under any zoom", () => {
    const wrong: number[] = [];
    for (let mmPerPixel = 1e-4; mmPerPixel < 10; mmPerPixel *= 1.07) {
      const length = roundLength(mmPerPixel);
      const pixels = length / mmPerPixel;
      const lead = Math.round(length / 10 ** Math.floor(Math.log10(length) + 1e-9));
      if (pixels > 150 * (1 + 1e-12) || pixels < 59 || ![1, 2, 5].includes(lead)) wrong.push(mmPerPixel);
    }
    expect(wrong).toEqual([]);
  });
});
