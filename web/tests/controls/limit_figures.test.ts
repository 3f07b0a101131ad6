import { expect, test } from "vitest";
import { limitFigures } from "../../src/controls/limit_figures.ts";
import { LIMITS } from "../support/limits.ts";

test("every limit is told with its unit", () => {
  const told = limitFigures({ ...LIMITS, stale: 0.015 });
  expect(Object.fromEntries(told.map(({ label, value }) => [label, value]))).toEqual({
    "peak force": "3.3 N",
    "long-run force": "0.88 N rms in any 10 s",
    "warm motors": "from 80 %",
    "ramp of the force": "0.5 s",
    "speed of the hand": "8 m/s",
    "same reading again": "15 ms",
    "late tick": "1 s",
    "needle’s direction": "length 1 ± 0.001",
    "dead-man button": "none",
  });
});

test("the dead-man buttons are named by their numbers", () => {
  expect(limitFigures({ ...LIMITS, dead_man_buttons: [1, 3] }).at(-1)?.value).toBe("button 1 or 3");
});
