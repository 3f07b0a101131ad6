import { describe, expect, it } from "vitest";
import type { Triple } from "../../src/engine/engine.ts";
import { Sticks, stick } from "../../src/hand/gamepad.ts";
import type { Hand } from "../../src/hand/hand.ts";
import { alongSkin, dot, length, tilted, tiltOf } from "../../src/hand/vectors.ts";
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

const NORMALS: readonly Triple[] = [
  [0, -1, 0],
  [1, 0, 0],
  [0, 0, 1],
  [0.6, -0.8, 0],
  [0.36, -0.8, 0.48],
];

describe.each(NORMALS)("a needle to the skin whose inward normal is (%d, %d, %d)", (...normal) => {
  it("leans in the plane of the normal and of a direction along the skin", () => {
    expect(dot(alongSkin(normal), normal)).toBeCloseTo(0, 12);
    expect(length(alongSkin(normal))).toBeCloseTo(1, 12);
  });

  it.each([-1.2, -0.3, 0, 0.5, 1.3])("by %d rad, as it was told", (angle) => {
    const axis = tilted(angle, normal);
    expect(length(axis)).toBeCloseTo(1, 12);
    expect(dot(axis, normal)).toBeCloseTo(Math.cos(angle), 12);
    expect(tiltOf(axis, normal)).toBeCloseTo(angle, 12);
  });
});
