import { describe, expect, it } from "vitest";
import { cutFigures, lastCut, limitOf } from "../../src/state/limits.ts";
import { history } from "../support/fill_history.ts";

describe("the limit that cuts the force", () => {
  const run = history(100, 1, {
    limit: (tick) => [tick < 10 ? 1 : tick >= 40 && tick < 60 ? 3 : tick === 99 ? 255 : 0],
    force: () => [0, 0.762, 0],
    model_force: () => [0, 2.19, 0],
  });

  it("is found in the last ticks; the ramp after arming and ticks that do not say are none", () => {
    expect(lastCut(run, 0)).toBe(59);
    expect(lastCut(run, 60)).toBeNull();
    expect(lastCut(history(5, 1, { limit: () => [1] }), 0)).toBeNull();
    expect(limitOf(run, 50)).toBe("continuous");
    expect(limitOf(run, 99)).toBe("unknown");
  });
  it("is shown with the device's force and the model's force", () => {
    expect(cutFigures(run, 50)).toBe("0.76 of 2.19 N");
  });
});
