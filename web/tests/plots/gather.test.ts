import { describe, expect, it } from "vitest";
import { difference, Extent, gather, gatherOther, gatherSize, gatherTime, isCompared } from "../../src/plots/gather.ts";
import { eachState } from "../../src/plots/states.ts";
import { frozenCopy } from "../../src/state/frozen.ts";
import { Source } from "../../src/state/source.ts";
import { batch, history } from "../support/fill_history.ts";

describe("gathering ticks for a drawing", () => {
  const two = history(250, 2, { depth: (tick) => [tick, 1000 + tick] }, 128);

  it("takes a membrane's column across the end of the rings", () => {
    const out = new Float32Array(10);
    gather({ history: two, first: 250 - 10, end: 250 }, "depth", 1, { gain: 2, bias: 0.5, out });
    expect([...out]).toEqual(Array.from({ length: 10 }, (_, i) => 2 * (1240 + i) + 0.5));
    expect([two.first, two.end]).toEqual([122, 250]);
  });

  it("keeps time apart to the tick", () => {
    const out = new Float32Array(3);
    gatherTime({ history: two, first: 240, end: 243 }, { gain: 1000, bias: -240, out });
    expect([...out]).toEqual([0, 1, 2].map((v) => expect.closeTo(v, 3)));
  });

  it("finds lowest and highest, and nothing where all is NaN", () => {
    const extent = new Extent();
    extent.takeColumn({ history: two, first: 130, end: 140 }, "depth", 0, -1);
    expect([extent.low, extent.high]).toEqual([-139, -130]);
    extent.forget();
    extent.takeColumn({ history: history(5, 1, { depth: () => [Number.NaN] }), first: 0, end: 5 }, "depth", 0, 1);
    expect(extent.low).toBeGreaterThan(extent.high);
  });

  it("the force at the hand is its size, as in an exercise's result, negative where it pulls the needle in", () => {
    const aside = history(2, 1, { force: (tick) => [0.3, tick ? -0.4 : 0.4, 0], axis: () => [0, -1, 0] });
    const out = new Float32Array(2);
    gatherSize({ history: aside, first: 0, end: 2 }, "force", { gain: 1, bias: 0, out });
    expect([...out]).toEqual([expect.closeTo(0.5, 6), expect.closeTo(-0.5, 6)]);
  });
});

describe("the other solver", () => {
  const compared = history(100, 1, {
    axial_force: () => [-0.5],
    model_force: () => [0, 0.5, 0],
    other_force: (tick) => [0, tick % 2 ? 0.6 : 0.4, 0],
    direction: () => [0, -1, 0],
    phase: (tick) => [tick < 10 ? 0 : 2],
  });

  const all = { history: compared, first: 0, end: 100 };

  it("its axial force is this one's and the difference along b, inside a membrane only", () => {
    const out = new Float32Array(100);
    gatherOther(all, 0, { gain: 1, bias: 0, out });
    expect(out[5]).toBeNaN();
    expect(out[20]).toBeCloseTo(-0.4, 6);
    expect(out[21]).toBeCloseTo(-0.6, 6);
  });

  it("their difference is told as root mean square and largest", () => {
    expect(difference(all)).toEqual({
      ticks: 100,
      rms: expect.closeTo(0.1, 6),
      largest: expect.closeTo(0.1, 6),
    });
  });

  it("without it there is no difference, and nothing to draw", () => {
    const none = { history: history(10, 1), first: 0, end: 10 };
    expect(difference(none)).toBeNull();
    expect(isCompared(none)).toBe(false);
    expect(isCompared(all)).toBe(true);
  });
});

describe("a frozen copy", () => {
  it("keeps every tick while the run goes on and forgets them", () => {
    const live = new Source("live", true, 3000);
    const cells = { depth: (tick: number) => [tick / 7], other_force: () => [1, 2, 3] };
    for (let first = 0; first < 5000; first += 50) live.history.push(batch(first, 50, 1, cells));
    const copy = frozenCopy(live);
    for (let first = 5000; first < 9000; first += 50) live.history.push(batch(first, 50, 1, cells));
    expect([copy.history.first, copy.history.end]).toEqual([2000, 5000]);
    for (const tick of [2000, 3456, 4999]) {
      expect(copy.history.row("depth", tick)[0]).toBe(Math.fround(tick / 7));
      expect([...copy.history.row("other_force", tick)]).toEqual([1, 2, 3]);
      expect(copy.history.timeOf(tick)).toBeCloseTo(tick / 1000, 7);
    }
    expect(live.history.first).toBe(6000);
  });
});

it("states are told in stretches", () => {
  const states = history(300, 1, { state: (tick) => [tick < 100 ? 0 : tick < 299 ? 2 : 3] });
  const told: unknown[] = [];
  eachState(states, 50, 300, (...stretch) => told.push(stretch));
  expect(told).toEqual([
    ["disarmed", 50, 100],
    ["active", 100, 299],
    ["faulted", 299, 300],
  ]);
});
