import { Vector3 } from "three";
import { expect, it } from "vitest";
import { Moment, OUTSIDE } from "../../src/scene/moment.ts";
import { planeOf, skinFrame } from "../../src/scene/probe.ts";
import { Denter, type Dents } from "../../src/slice/dents.ts";
import { tissueOf } from "../../src/slice/layers.ts";
import { paintTissue, type Raster, shadowOf } from "../../src/slice/picture.ts";
import { plainScene } from "../support/plain_scene.ts";

const scene = plainScene;
const skin = skinFrame(scene);
const tissue = tissueOf(scene, skin);
const raster: Raster = { columns: 120, rows: 150, width: 12, depth: 15 };
const step = raster.depth / raster.rows;
const denter = new Denter(skin, tissue, raster.depth, 0.8);
const open = new Float32Array(raster.columns).fill(Number.POSITIVE_INFINITY);

function outside(): Moment {
  const moment = new Moment();
  moment.tip.set(0, 5, 0);
  moment.membranes = scene.membranes.map(() => ({
    phase: OUTSIDE, depth: 0, proxy: new Vector3(), direction: new Vector3(),
  })); // biome-ignore format: short
  return moment;
}

function painted(place = { x: 0, z: 0, turn: 0 }, change = (dents: Dents): Dents => dents, shadow = open): Uint32Array {
  const plane = planeOf(skin, place);
  const dents = change(denter.at(outside()));
  const out = new Uint32Array(raster.columns * raster.rows);
  paintTissue(out, raster, plane, skin, tissue, dents, shadow);
  return out;
}

const grey = (picture: Uint32Array, along: number, depth: number): number => {
  const column = Math.round(((along + raster.width / 2) / raster.width) * raster.columns - 0.5);
  return picture[Math.round(depth / step - 0.5) * raster.columns + column]! & 0xff;
};
const mean = (picture: Uint32Array, from: number, to: number, depth: number): number => {
  let sum = 0;
  let count = 0;
  for (let along = from; along < to; along += 0.1, count++) sum += grey(picture, along, depth);
  return sum / count;
};

it("blood is black and its walls are bright", () => {
  const picture = painted({ x: 0, z: 0, turn: Math.PI / 2 }); // across the vein
  const { depth, radius } = tissue.vessel!;
  expect(mean(picture, -0.8, 0.8, depth)).toBeLessThan(40);
  expect(grey(picture, 0, depth - radius - 0.15)).toBeGreaterThan(90);
  expect(mean(picture, 3, 5, depth)).toBeGreaterThan(40); // beside the vein is tissue
});

it("a slice beside the vein does not show it", () => {
  const { depth } = tissue.vessel!;
  expect(mean(painted({ x: 0, z: 0, turn: 0 }), -3, 3, depth)).toBeLessThan(40);
  expect(mean(painted({ x: 0, z: 4, turn: 0 }), -3, 3, depth)).toBeGreaterThan(40);
});

it("the speckle is the same in each picture, and another in a slice 1 mm away", () => {
  expect(painted()).toEqual(painted());
  expect(painted({ x: 0, z: 1, turn: 0 })).not.toEqual(painted());
});

it("a moved probe shows the same tissue at another place", () => {
  const moved = painted({ x: 1, z: 0, turn: 0 });
  const still = painted();
  for (const along of [-3, 0, 2]) {
    expect(Math.abs(grey(moved, along, 2.55) - grey(still, along + 1, 2.55))).toBeLessThanOrEqual(1);
  }
});

it("the speckle moves with the displaced tissue", () => {
  const half = (dents: Dents): Dents => {
    // Everything 0.5 mm deeper: a very wide dent.
    return { ...dents, down: dents.down.map(() => 0.5), most: 0.5, reach: 1e6 };
  };
  const pressed = painted(undefined, half);
  const before = painted();
  const differences = [-3, -1, 0.5, 2].map((along) => grey(pressed, along, 3.05) - grey(before, along, 2.55));
  for (const difference of differences) expect(Math.abs(difference)).toBeLessThan(8); // only the fading differs
});

it("the needle darkens what lies behind it", () => {
  const shadow = new Float32Array(raster.columns);
  shadowOf(
    { deep: { along: 0, depth: 4 }, shallow: { along: -4, depth: 2 }, tip: true, off: 0, along: true },
    0.4,
    raster,
    shadow,
  );
  expect(shadow[Math.round((2 / 12) * 120)]).toBeCloseTo(2.4 + 0.0, 0);
  expect(shadow[110]).toBe(Number.POSITIVE_INFINITY);
  const dark = painted(undefined, undefined, shadow);
  expect(mean(dark, -3, -1, 4.2)).toBeLessThan(0.7 * mean(painted(), -3, -1, 4.2));
});
