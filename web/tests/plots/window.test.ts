import { describe, expect, it } from "vitest";
import { nearestTick, Scrolled, Window } from "../../src/plots/window.ts";
import { History, tickAt } from "../../src/state/history.ts";
import { history } from "../support/fill_history.ts";

describe("a window of time", () => {
  const run = history(10_000, 1, {}, 6000); // ticks 4000 to 9999: 4.000 s to 9.999 s

  it("finds ticks by their time", () => {
    expect(tickAt(run, 5)).toBe(5000);
    expect(tickAt(run, 0)).toBe(4000);
    expect(tickAt(run, 99)).toBe(10_000);
    expect(nearestTick(run, 5.0004)).toBe(5000);
    expect(nearestTick(run, 5.0006)).toBe(5001);
    expect(nearestTick(run, 99)).toBe(9999);
    expect(nearestTick(new History(4), 1)).toBeNull();
  });

  it("follows a live run to its last tick, in whole pixels", () => {
    const window = new Window();
    window.follow(run, 9999, 2, true, 0.005);
    expect(window.to).toBeGreaterThanOrEqual(9.999);
    expect(window.to - 9.999).toBeLessThan(0.005);
    expect((window.from / 0.005) % 1).toBeCloseTo(0, 6);
    expect(window.end).toBe(10_000);
    expect(Math.abs(window.first - 8000)).toBeLessThanOrEqual(1);
  });

  it("a run shorter than the window fills it from the left", () => {
    const window = new Window();
    window.follow(history(500, 1), 499, 20, true, 0.05);
    expect([window.from, window.to]).toEqual([0, 20]);
    expect([window.first, window.end]).toEqual([0, 500]);
  });

  it("a recording shows a little of what comes after its cursor", () => {
    const window = new Window();
    window.follow(run, 7000, 2, false, 0.005);
    expect(window.to).toBeCloseTo(7.5, 2);
  });

  it("is empty where there is nothing", () => {
    const window = new Window();
    window.follow(new History(4), null, 5, true, 0.01);
    expect(window.end - window.first).toBe(0);
  });
});

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
