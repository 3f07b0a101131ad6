import { describe, expect, it } from "vitest";
import { type Layer, layersOf, vesselOf } from "../../src/tissue/layers.ts";
import { cells, cloud, noise } from "../../src/tissue/noise.ts";
import { cutSheet, endSheet, type Sheet, surfaceSheet } from "../../src/tissue/sheet.ts";
import type { MembraneView } from "../../src/wire/messages.ts";

const membrane = (
  look: MembraneView["look"],
  at: number,
  thickness: number,
  behind: MembraneView["behind"] = "tissue",
): MembraneView => ({
  name: look,
  point: [0, -at / 1000, 0],
  inward_normal: [0, -1, 0],
  thickness: thickness / 1000,
  look,
  behind,
});
const arm = [
  membrane("skin", 0, 1.2, "fat"),
  membrane("vein wall", 4, 0.4, "blood"),
  membrane("vein wall", 7, 0.4, "muscle"),
];

describe("the layers of a scene", () => {
  it("follow each other from the surface down, with the spaces between them, and have no gaps", () => {
    const layers = layersOf({ membranes: [arm[2]!, arm[0]!, arm[1]!] })!;
    expect(layers.map(({ fill }) => fill)).toEqual(["skin", "fat", "vein wall", "blood", "vein wall", "muscle"]);
    expect(layers.map(({ membrane }) => membrane)).toEqual([1, null, 2, null, 0, null]);
    for (const [i, { top }] of layers.slice(1).entries()) expect(top).toBeCloseTo(layers[i]!.bottom, 9);
    expect(vesselOf({ lumen: [2, 0] }, layers)!.inner).toEqual([expect.closeTo(4.4, 9), expect.closeTo(7, 9)]);
  });

  it("are not drawn if all membranes are plain, or if they are not parallel", () => {
    expect(layersOf({ membranes: [membrane("plain", 0, 1), membrane("plain", 3, 1)] })).toBeNull();
    expect(layersOf({ membranes: [arm[0]!, { ...arm[1]!, inward_normal: [0, 0, 1] }] })).toBeNull();
    expect(layersOf({ membranes: [] })).toBeNull();
  });

  it("show a membrane without thickness, and cut one that reaches into the next", () => {
    const [thin] = layersOf({ membranes: [membrane("dura", 0, 0)] })!;
    expect(thin!.bottom).toBeGreaterThan(0.05);
    const [upper, lower] = layersOf({ membranes: [membrane("fat", 0, 9), membrane("fascia", 5, 1)] })!;
    expect([upper!.bottom, lower!.top]).toEqual([5, 5]);
  });
});

const mean = ({ pixels, width }: Sheet, from: number, to: number): number[] => {
  const sum = [0, 0, 0];
  for (let i = from * width; i < to * width; i++) for (const c of [0, 1, 2]) sum[c]! += pixels[4 * i + c]!;
  return sum.map((s) => s / ((to - from) * width));
};

describe("a painted sheet", () => {
  const layers: readonly Layer[] = layersOf({ membranes: arm })!;
  const vessel = vesselOf({ lumen: [1, 2] }, layers);

  it("is the same each time, and its left border fits its right one", () => {
    const [one, other] = [0, 1].map(() => cutSheet(layers, vessel, 20, 6));
    for (const sheet of [one!, other!]) sheet.paint(0, sheet.height, 1);
    expect(one!.pixels).toEqual(other!.pixels);
    const column = (i: number): number[] =>
      Array.from({ length: one!.height }, (_, y) => one!.pixels[4 * (y * one!.width + i)]!);
    const apart = (a: number, b: number): number =>
      column(a).reduce((sum, x, y) => sum + Math.abs(x - column(b)[y]!), 0);
    expect(apart(0, one!.width - 1)).toBeLessThan(2.5 * apart(40, 41) + 200);
  });

  it("has layers that differ in brightness, so that they can be told apart without seeing colours", () => {
    const sheet = cutSheet(layers, vessel, 20, 6);
    sheet.paint(0, sheet.height, 1);
    const rows = layers.map(({ top, bottom }) =>
      [top, bottom].map((d) => Math.round((d / layers.at(-1)!.bottom) * sheet.height)),
    );
    const bright = rows
      .map(([from, to]) => mean(sheet, from!, Math.max(from! + 1, to!)))
      .map(([r, g, b]) => 0.3 * r! + 0.6 * g! + 0.1 * b!);
    for (const [i, light] of bright.slice(1).entries()) expect(Math.abs(light - bright[i]!)).toBeGreaterThan(8);
  });

  it("leaves the lumen open at the block's end, and only that", () => {
    const end = endSheet(layers, vessel, 10, 6);
    end.paint(0, end.height, 1);
    let open = 0;
    for (let i = 3; i < end.pixels.length; i += 4) if (end.pixels[i] === 0) open++;
    const radius = (vessel!.inner[1] - vessel!.inner[0]) / 2;
    expect(open / 36).toBeCloseTo((Math.PI * radius ** 2) / 2, 0);
    const surface = surfaceSheet(layers, 10, 6);
    surface.paint(0, surface.height, 1);
    expect(surface.pixels.every((value, i) => i % 4 !== 3 || value === 255)).toBe(true);
  });
});

it("noise stays between 0 and 1 and repeats after its period", () => {
  const cell = { first: 0, second: 0, value: 0 };
  for (let i = 0; i < 300; i++) {
    const [x, y] = [i * 0.37 - 40, i * 0.11 - 9];
    for (const value of [noise(x, y, 12), cloud(x, y, 12)]) expect(value >= 0 && value <= 1).toBe(true);
    expect(noise(x + 12, y, 12)).toBeCloseTo(noise(x, y, 12), 9);
    const { first, second } = { ...cells(x, y, 12, cell) };
    expect(second).toBeGreaterThanOrEqual(first);
    expect(cells(x - 12, y, 12, cell).first).toBeCloseTo(first, 9);
  }
});
