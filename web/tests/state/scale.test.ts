import { describe, expect, it } from "vitest";
import { popLabel } from "../../src/plots/marks.ts";
import { cutFigures } from "../../src/state/limits.ts";
import {
  fallenForce,
  fallOf,
  feltDropText,
  feltForce,
  feltShare,
  feltShareText,
  scaleOf,
  scaleText,
} from "../../src/state/scale.ts";
import { Source } from "../../src/state/source.ts";
import type { MembraneEvent, SceneView } from "../../src/wire/messages.ts";
import { batch } from "../support/fill_history.ts";

/** 10 ticks with a model force of 2 N, of which the device gives 0.3, and less while a limit acts. */
function source(): Source {
  const made = new Source("test", true, 10);
  const given = (tick: number): number => (tick < 5 ? 0.6 : 0.45);
  made.history.push(
    batch(0, 10, 1, {
      model_force: () => [0, 2, 0],
      force: (tick) => [0, given(tick), 0],
      force_scale: () => [0.3],
    }),
  );
  return made;
}

describe("the force scale", () => {
  it("stands in the name of the felt force, unless the device gives all of the model's force", () => {
    expect(feltForce(1)).toBe("felt force");
    expect(feltForce(0.3)).toBe("felt force (× 0.30)");
    expect(scaleText(0.0664)).toBe("0.066");
    expect(scaleText(0.0996)).toBe("0.10");
  });
  it("is that of the tick, or of the scene where a recording of an earlier version does not tell it", () => {
    const shown = source();
    expect(scaleOf(shown)).toBeCloseTo(0.3);
    shown.history.column("force_scale").fill(Number.NaN);
    expect(scaleOf(shown)).toBe(1);
    shown.scene.value = { force_scale: 0.5 } as SceneView;
    expect(scaleOf(shown)).toBe(0.5);
    expect(scaleOf(new Source("empty", true, 4))).toBe(1);
  });
  it("and the limits give the felt share of a force", () => {
    const { history } = source();
    expect(feltShare(history, 0)).toBeCloseTo(0.3);
    expect(feltShare(history, 9)).toBeCloseTo(0.225);
    history.column("model_force").fill(0);
    expect(feltShare(history, 9)).toBe(0);
  });
  it("a pop names the model force unless the hand felt all of it at that moment", () => {
    const cells = { model_force: () => [0, 2, 0], force: (tick: number) => [0, tick < 5 ? 2 : tick < 8 ? 1.5 : 0, 0] };
    const { history } = new Source("test", true, 10);
    history.push(batch(0, 10, 1, cells));
    expect([1, 5, 6, 9].map((tick) => fallenForce(history, tick))).toEqual([
      "force", "model force", "model force", "model force",
    ]); // biome-ignore format: a list
    expect(fallenForce(history, 10)).toBe("model force"); // not kept
    expect(popLabel({ tick: 3, drop: 0.5 } as MembraneEvent, history)).toBe("pop −0.50 N");
    expect(popLabel({ tick: 7, drop: 0.5 } as MembraneEvent, history)).toBe("pop, model force −0.50 N");
  });
  it("gives the drop that is felt, unless a limit cut it", () => {
    const pop = (tick: number): MembraneEvent => ({ tick, drop: 2 }) as MembraneEvent;
    const { history } = source();
    expect([4, 5, 10].map((tick) => feltDropText(history, pop(tick)))).toEqual([
      "−0.60 N", "model force −2.00 N", "model force −2.00 N",
    ]); // biome-ignore format: a list
    expect([4, 5].map((tick) => fallOf(history, pop(tick)))).toEqual([
      "felt force fell by 0.60 N", "model force fell by 2.00 N",
    ]); // biome-ignore format: a list
  });
  it("is no cut: a cut tells the felt force, and what it would be without the limit", () => {
    expect(cutFigures(source().history, 9)).toBe("0.45 of 0.60 N");
  });
});

it("a learner reads how much of the model's force is felt", () => {
  expect([1, 0.055, 0.3].map(feltShareText)).toEqual([
    "felt force",
    "felt force: 5.5 % of the model force",
    "felt force: 30 % of the model force",
  ]);
});
