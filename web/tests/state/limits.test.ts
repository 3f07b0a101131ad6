import { describe, expect, it } from "vitest";
import type { App } from "../../src/state/app.ts";
import { controlWords } from "../../src/state/control.ts";
import { cutFigures, cutSentence, lastCut, limitOf } from "../../src/state/limits.ts";
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
  it("is told to a learner with what to do", () => {
    expect(cutSentence(run, 50)).toBe(
      "Force cut: long-run limit, 0.76 of 2.19 N. Draw back a little for some seconds, then it comes back.",
    );
  });
});

it.each([
  [true, ["You move the needle", "Another page moves the needle", "Nobody moves the needle"]],
  [false, ["You have control", "Another page has control", "No page has control"]],
])("says who has control; of a simulated device (%s), who moves the needle", (simulated, words) => {
  const said = [
    { you: true, holder: 1 },
    { you: false, holder: 2 },
    { you: false, holder: null },
  ].map((value) => controlWords({ control: { value }, hello: { value: { device: { simulated } } } } as unknown as App));
  expect(said).toEqual(words);
});
