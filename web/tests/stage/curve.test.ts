import { describe, expect, it } from "vitest";
import { endOf, placedNames, shortened } from "../../src/stage/curve.ts";
import type { Band } from "../../src/tissue/bands.ts";

const band = (name: string, top: number, bottom: number): Band => ({ name, top, bottom, tone: null, membrane: null });
const EPIDURAL = [
  band("skin", 0, 2.5),
  band("fat", 2.5, 18),
  band("", 18, 20),
  band("ligament", 20, 42),
  band("flavum", 42, 45),
  band("space", 45, 49.6),
  band("dura", 49.6, 50),
  band("fluid", 50, 58),
];

describe("the names of the layers", () => {
  const names = (pxPerMm: number) => placedNames(EPIDURAL, (mm) => 10 + pxPerMm * mm, 13, 10 + 58 * pxPerMm);

  it("are all there where each has room", () => {
    expect(names(8).map(({ name }) => name)).toEqual(["skin", "fat", "ligament", "flavum", "space", "dura", "fluid"]);
  });

  it("leave out the thinnest layers where there is no room, and stay apart, in order and inside the picture", () => {
    const few = names(1.2);
    expect(few.map(({ name }) => name)).not.toContain("dura");
    expect(few.length).toBeGreaterThan(3);
    for (const [i, { y }] of few.slice(1).entries()) expect(y - few[i]!.y).toBeGreaterThanOrEqual(14);
    expect(few.at(-1)!.y).toBeLessThanOrEqual(10 + 58 * 1.2);
  });

  it("are at their own layers", () => {
    for (const { name, y } of names(1.2)) {
      const { top, bottom } = EPIDURAL.find((one) => one.name === name)!;
      expect(Math.abs(y - 10 - 0.6 * (top + bottom))).toBeLessThanOrEqual(Math.max(6.5, 0.6 * (bottom - top)));
    }
  });

  it("make room for each other on both sides, so that all of a vein are there at a zoom of 200 %", () => {
    const walls = [1.2, 4.81, 5.21, 8.22, 8.62, 14.6];
    const vein = walls.map((bottom, i) => band(`layer ${i}`, walls[i - 1] ?? 0, bottom));
    expect(placedNames(vein, (mm) => 6.1 * mm, 13, 92)).toHaveLength(6);
  });
});

it("of many thin layers, names are left out evenly, and each is at its own layer", () => {
  const many = Array.from({ length: 64 }, (_, i) => band(`layer ${i + 1}`, i, i + 1));
  const shown = placedNames(many, (mm) => 4.3 * mm, 13, 300).map(({ name }) => Number(name.slice(6)));
  const steps = shown.slice(1).map((number, i) => number - shown[i]!);
  expect(shown.length).toBeGreaterThan(10);
  expect([Math.min(...steps) >= 2, Math.max(...steps) <= 8]).toEqual([true, true]);
});

it("a name that would lie under the curve is shortened", () => {
  expect(shortened("skin", 90, 12)).toBe("skin");
  expect(shortened("interspinous ligament", 90, 12)).toBe("interspinous…");
  expect(shortened("layer number 12", 90, 12)).toBe("layer numb… 12");
});

it("bands and axis go as deep as the needle and the goal, in steps", () => {
  expect([endOf(6, 0), endOf(6, 6)]).toEqual([6, 6]);
  expect(endOf(6, 6.1)).toBeCloseTo(7.2, 9);
  expect(endOf(6, 12)).toBeCloseTo(12.6, 9);
});
