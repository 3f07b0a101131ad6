import { describe, expect, it } from "vitest";
import { Scrolled, Window } from "../../src/plots/window.ts";

const PER_SECOND = 30; // px

const window = (from: number, first: number, end: number): Window =>
  Object.assign(new Window(), { from, to: from + 20, first, end });

/** A layer that shows the window from 10 s on and the ticks 100 to 199. */
function drawn(): Scrolled {
  const layer = new Scrolled();
  expect(layer.step("looks", window(10, 100, 200), PER_SECOND)).toBeNull();
  layer.end = 200;
  return layer;
}

describe("a layer of curves", () => {
  it("stays where it is while only ticks are added", () => {
    expect(drawn().step("looks", window(10, 100, 230), PER_SECOND)).toBe(0);
  });

  it("moves with its window by whole pixels, step after step", () => {
    const layer = drawn();
    for (let i = 1; i <= 5; i++) {
      expect(layer.step("looks", window(10 + (4 * i) / PER_SECOND, 100 + i, 200 + i), PER_SECOND)).toBe(4);
      layer.end = 200 + i;
    }
  });

  it.each([
    ["something else has changed", "other looks", window(10, 100, 200), PER_SECOND],
    ["the scale has changed", "looks", window(10, 100, 200), 2 * PER_SECOND],
    ["the window moves by a part of a pixel", "looks", window(10.01, 100, 200), PER_SECOND],
    ["the window goes back", "looks", window(9, 90, 200), PER_SECOND],
    ["the window has none of the drawn ticks", "looks", window(30, 200, 400), PER_SECOND],
    ["drawn ticks are no longer there", "looks", window(10, 100, 150), PER_SECOND],
  ])("is drawn again if %s", (_, key, next, perSecond) => {
    expect(drawn().step(key, next, perSecond)).toBeNull();
  });
});
