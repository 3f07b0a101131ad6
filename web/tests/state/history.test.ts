import { describe, expect, it } from "vitest";
import { History } from "../../src/state/history.ts";
import { decodeTicks } from "../../src/wire/ticks.ts";
import type { FrameShape } from "../wire/frame.ts";
import { expected, expectedByte, makeFrame } from "../wire/frame.ts";

const batch = (shape: FrameShape) => decodeTicks(makeFrame(shape));

/** Every tick that the history says it has is the one that was sent. */
function whole(history: History): void {
  const m = history.membranes;
  const wrong: number[] = [];
  for (let tick = history.first; tick < history.end; tick++) {
    const right =
      Math.abs(history.timeOf(tick) - tick / 1600) < 1e-6 &&
      history.row("proxy", tick).length === 3 * m &&
      history.row("tip", tick).every((value, place) => value === expected("tip", tick, place)) &&
      history.row("depth", tick).every((value, place) => value === expected("depth", tick, place)) &&
      history.byteRow("phase", tick).every((value, place) => value === expectedByte("phase", tick, place)) &&
      history.byteRow("state", tick)[0] === expectedByte("state", tick, 0);
    if (!right) wrong.push(tick);
  }
  expect(wrong).toEqual([]);
}

describe("the history", () => {
  it("keeps every tick of batches of any size, and forgets the oldest", () => {
    const history = new History(100);
    history.clear(2);
    let first = 0;
    for (const count of [1, 26, 27, 26, 40, 3, 99, 100, 1, 26]) {
      history.push(batch({ first, count, membranes: 2 }));
      first += count;
      expect(history.end).toBe(first);
      expect(history.first).toBe(Math.max(0, first - 100));
      whole(history);
    }
  });

  it("starts again after a gap, because the two sides do not belong together", () => {
    const history = new History(100);
    history.push(batch({ first: 0, count: 20, membranes: 1 }));
    history.push(batch({ first: 30, count: 20, membranes: 1, lost: 10 }));
    expect([history.first, history.end, history.lost]).toEqual([30, 50, 10]);
    whole(history);
  });

  it("takes a batch longer than it has room for: its end stays", () => {
    const history = new History(50);
    history.push(batch({ first: 0, count: 120, membranes: 1 }));
    expect([history.first, history.end]).toEqual([70, 120]);
    whole(history);
  });

  it("changes its generation and its width with a run of other membranes", () => {
    const history = new History(50);
    history.push(batch({ first: 0, count: 10, membranes: 1 }));
    const before = history.generation;
    history.push(batch({ first: 0, count: 10, membranes: 3 }));
    expect(history.generation).toBeGreaterThan(before);
    expect([history.membranes, history.first, history.end]).toEqual([3, 0, 10]);
    whole(history);
  });

  it("has no number for the other solver where none was sent", () => {
    const history = new History(50);
    history.push(batch({ first: 0, count: 2, membranes: 1 }));
    history.push(batch({ first: 2, count: 2, membranes: 1, other: true }));
    expect([...history.row("other_force", 1)]).toEqual([Number.NaN, Number.NaN, Number.NaN]);
    expect([...history.row("other_force", 2)]).toEqual([0, 1, 2].map((place) => expected("other_force", 2, place)));
  });
});
