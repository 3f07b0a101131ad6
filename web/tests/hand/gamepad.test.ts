import { describe, expect, it } from "vitest";
import { Sticks, stick } from "../../src/hand/gamepad.ts";
import type { Hand } from "../../src/hand/hand.ts";
import { Signal } from "../../src/state/signal.ts";

describe("a stick", () => {
  it("gives 0 near its middle, fine control next to it, and full speed at its end", () => {
    expect([stick(0), stick(0.1), stick(-0.12), stick(undefined), stick(Number.NaN)].map(Math.abs)).toEqual([
      0, 0, 0, 0, 0,
    ]);
    expect(stick(0.3)).toBeGreaterThan(0);
    expect(stick(0.3)).toBeLessThan(0.1);
    expect(stick(1)).toBe(1);
    expect(stick(-1)).toBe(-1);
    expect(stick(-0.6)).toBeCloseTo(-stick(0.6), 12);
  });
});

describe("sticks that were held when a new run began", () => {
  it("move nothing until they have come to rest", () => {
    let moved = 0;
    const hand = {
      run: 0,
      barred: new Signal<string | null>(null),
      pose: () => ({ position: [0, 0, 0], axis: [0, -1, 0] }),
      side: () => [1, 0, 0],
      near: () => [0, 0, 1],
      moveTo: () => {
        moved += 1;
      },
    };
    const sticks = new Sticks(hand as unknown as Hand);
    const lead = (...axes: number[]): void => sticks.lead({ axes } as unknown as Gamepad, 0.01);
    lead(0, -1, 0, 0);
    expect(moved).toBe(1);
    hand.run = 1;
    lead(0, -1, 0, 0);
    lead(0, -0.5, 0, 0);
    expect(moved).toBe(1);
    lead(0, 0.05, 0, 0);
    lead(0, -1, 0, 0);
    expect(moved).toBe(2);
  });
});
