import { describe, expect, it } from "vitest";
import { plateauWords, slopeWords } from "../../../src/controls/lab/estimate.ts";

describe("the live estimate", () => {
  it("is told with units and the half of its 95 % interval", () => {
    expect(slopeWords({ value: 212.34, half: 11.8 })).toBe("0.212 ± 0.012 N/mm");
    expect(plateauWords({ value: 0.41024, half: 0.0021 })).toBe("0.410 ± 0.002 N");
  });

  it("is a dash while it is not known", () => {
    expect([slopeWords(null), plateauWords(null)]).toEqual(["–", "–"]);
  });
});
