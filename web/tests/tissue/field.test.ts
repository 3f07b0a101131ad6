import { describe, expect, it } from "vitest";
import { bounded, Field, type Grip, type Spot } from "../../src/tissue/field.ts";
import type { Layer } from "../../src/tissue/layers.ts";

const ARM: readonly Layer[] = [
  { fill: "skin", membrane: 0, top: 0, bottom: 1.2 },
  { fill: "fat", membrane: null, top: 1.2, bottom: 4.81 },
  { fill: "vein wall", membrane: 1, top: 4.81, bottom: 5.21 },
  { fill: "blood", membrane: null, top: 5.21, bottom: 8.22 },
  { fill: "vein wall", membrane: 2, top: 8.22, bottom: 8.62 },
  { fill: "muscle", membrane: null, top: 8.62, bottom: 14.6 },
];
const grip = (membrane: number, d: number, u = 0, slope = 0): Grip => ({ membrane, proxy: { u, d }, slope });

function field(tip: Spot, grips: readonly Grip[], lean = 1): Field {
  const made = new Field(ARM, 0.82);
  made.set(tip, grips, lean);
  return made;
}
const depths = Array.from({ length: 150 }, (_, i) => (14.6 * i) / 149);
const at = (of: Field, d: number): { track: number; u: number; down: number } => of.at(d, { track: 0, u: 0, down: 0 });

describe("the tissue round a needle", () => {
  it("is at rest without a membrane that holds the needle", () => {
    const rest = field({ u: 3, d: -2 }, []);
    for (const d of [-1, 0, 3, 20]) expect(at(rest, d)).toEqual({ track: 0, u: 0, down: 0 });
  });

  it("is at the tip where the proxy is, so that the drawn tip never stands in tissue that it has not pierced", () => {
    for (const [q, tip] of [
      [0.1, 0.9],
      [0.8, 2.6],
      [0.3, 0.2],
    ] as const) {
      const dented = field({ u: 1, d: tip }, [grip(0, q, 0.7)]);
      expect(q + at(dented, q).down).toBeCloseTo(tip, 9);
      expect(0.7 + at(dented, q).u).toBeCloseTo(1, 9);
      const ahead = depths.filter((d) => d > q).map((d) => d + at(dented, d).down);
      expect(Math.min(...ahead)).toBeGreaterThanOrEqual(tip - 1e-9);
    }
  });

  it("flattens the vein before the wall behind it moves, and lets it fill when the front wall gives", () => {
    const pressed = field({ u: 0, d: 6.9 }, [grip(0, 6.5), grip(1, 5.0)]);
    expect(at(pressed, 5.0).down).toBeCloseTo(1.9, 9);
    expect(at(pressed, 5.21).down).toBeGreaterThan(1.5);
    expect(at(pressed, 8.22).down).toBeLessThan(0.05);
    const filled = field({ u: 0, d: 6.9 }, [grip(0, 6.5), grip(1, 6.85)]);
    expect(at(filled, 5.0).down).toBeCloseTo(0.05, 9);
    expect(at(filled, 5.21).down).toBeLessThan(0.05);
    expect(at(filled, 8.22).down).toBeCloseTo(0, 9);
  });

  it("never turns its layers over and never moves far, whatever the proxies are", () => {
    let state = 1;
    const random = (low: number, high: number): number => {
      state = (state * 48271) % 2147483647;
      return low + (high - low) * (state / 2147483647);
    };
    const wrong: unknown[] = [];
    for (let run = 0; run < 500; run++) {
      const wild = run % 2 ? 200 : 8;
      const tip = { u: random(-wild, wild), d: random(-3, wild) };
      const grips = [0, 1, 2]
        .filter(() => random(0, 1) > 0.3)
        .map((membrane) => grip(membrane, ARM[2 * membrane]!.top + random(0, 12), random(-wild, wild), random(-3, 3)));
      const moved = field(tip, grips, random(-1, 1));
      let before = Number.NEGATIVE_INFINITY;
      for (const d of depths) {
        const { u, down } = at(moved, d);
        if (!(Math.abs(u) <= 4 && down <= 9 && d + down >= before)) wrong.push({ tip, grips, d, u, down });
        before = d + down;
      }
    }
    expect(wrong).toEqual([]);
  });

  it("moves without a jump while the tip goes on without a pop", () => {
    let before: number[] | null = null;
    let most = 0;
    for (let tip = -1; tip < 3; tip += 0.02) {
      const now = field({ u: 0, d: tip }, tip > 0 ? [grip(0, 0.3 * tip)] : []);
      const shifts = depths.map((d) => at(now, d).down);
      for (const [i, shift] of shifts.entries()) most = Math.max(most, Math.abs(shift - (before?.[i] ?? shift)));
      before = shifts;
    }
    expect(most).toBeLessThan(0.05);
  });

  it("gives way fully at the needle, less at a distance, and the same on both sides", () => {
    const dented = field({ u: 0, d: 2 }, [grip(0, 0.5)]);
    expect(dented.share(0)).toBe(1);
    expect(dented.share(2)).toBe(dented.share(-2));
    expect(dented.share(1)).toBeGreaterThan(dented.share(2));
    expect(dented.share(60)).toBeLessThan(1e-3);
  });

  it("follows a slanted needle: the dent is on the needle's track at each depth", () => {
    const slanted = field({ u: 4, d: 2 }, [grip(0, 1.5, 3.4, 1.7)], 0.5);
    expect(at(slanted, 0.5).track).toBeCloseTo(3.4 - 1.7, 9);
    expect(at(slanted, 0).track).toBeCloseTo(3.4 - 1.7 * 1.5, 9);
  });
});

it("a bounded number keeps small values and never passes its limit", () => {
  expect(bounded(0.5, 1)).toBe(0.5);
  expect(bounded(-0.5, 1)).toBe(-0.5);
  expect(bounded(1e9, 1)).toBeLessThanOrEqual(1);
  expect(bounded(0.7, 1)).toBeGreaterThan(bounded(0.69, 1));
  expect(bounded(3, 0)).toBe(0);
});
