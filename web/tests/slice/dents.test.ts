import { Vector3 } from "three";
import { expect, it } from "vitest";
import { Moment, OUTSIDE } from "../../src/scene/moment.ts";
import { skinFrame, wrapped } from "../../src/scene/probe.ts";
import { moved, Quality } from "../../src/slice/controls.ts";
import { Denter, type Dents, displaced } from "../../src/slice/dents.ts";
import { frameOf, rasterOf, rulerMarks } from "../../src/slice/drawing.ts";
import { tissueOf } from "../../src/slice/layers.ts";
import { lumenHeight } from "../../src/slice/slice.ts";
import { plainScene } from "../support/plain_scene.ts";

const SLIDING_IN = 2;
const down = new Vector3(0, -1, 0);
const scene = plainScene;
const skin = skinFrame(scene);
const tissue = tissueOf(scene, skin);
const dents = (moment: Moment): Dents => new Denter(skin, tissue, 15, 0.8).at(moment);

/** The needle pushes the front wall by `lead` mm, with its proxy `depth` mm behind the wall's front. */
function pushing(lead: number, depth: number): Moment {
  const moment = new Moment();
  moment.tip.set(0, -4.81 - depth - lead, 0);
  const none = { phase: OUTSIDE, depth: 0, proxy: new Vector3(), direction: new Vector3() };
  const held = { phase: SLIDING_IN, depth, proxy: new Vector3(0, -4.81 - depth, 0), direction: down.clone() };
  moment.membranes = [none, held, { ...none }];
  return moment;
}

it("the wall's tissue at the proxy is where the tip is", () => {
  expect(displaced(4.81 + 0.2, dents(pushing(0.8, 0.2)))).toBeCloseTo(4.81 + 0.2 + 0.8, 1);
});

it("without contact nothing is displaced", () => {
  const moment = pushing(0.8, 0.2);
  moment.membranes[1]!.phase = OUTSIDE;
  expect(dents(moment).most).toBe(0);
});

it("a vein flattens while the needle pushes its wall", () => {
  const height = (lead: number): number => lumenHeight(tissue, dents(pushing(lead, 0.2)));
  expect(height(0)).toBeCloseTo(2 * tissue.vessel!.radius, 1);
  expect(height(1.2)).toBeLessThan(0.8 * height(0));
  expect(height(2.4)).toBeLessThan(height(1.2));
});

it("a vein lies beneath the fat that the scene gives, and its walls are not layers", () => {
  expect(tissue.vessel!.depth).toBeCloseTo((4.81 + 0.4 + 8.22) / 2, 6);
  expect(tissue.layers.some(({ fill }) => fill === "blood")).toBe(false);
});

it("the probe moves in its own directions, and stays within reach", () => {
  const turned = moved({ x: 0, z: 0, turn: Math.PI / 2 }, 2, 0);
  expect(turned.x).toBeCloseTo(0, 9);
  expect(turned.z).toBeCloseTo(2, 9);
  expect(moved({ x: 24, z: 0, turn: 0 }, 9, 0).x).toBe(25);
});

it("a turn stays between -90 and 90 degrees", () => {
  expect(wrapped((100 * Math.PI) / 180)).toBeCloseTo((-80 * Math.PI) / 180, 9);
  expect(wrapped(Math.PI)).toBeCloseTo(0, 9);
});

it("a millimetre is as long across as down, and the picture is not wider than a probe", () => {
  const wide = frameOf(1200, 300, 15);
  expect(wide.width).toBeLessThanOrEqual(50);
  expect(wide.x(1) - wide.x(0)).toBeCloseTo(wide.y(1) - wide.y(0), 9);
  const tall = frameOf(200, 600, 60);
  expect(tall.x(tall.width / 2)).toBeLessThanOrEqual(200);
});

it("the raster has about the pixels that it may have", () => {
  const { columns, rows } = rasterOf(frameOf(500, 400, 15), 26_000);
  expect(columns * rows).toBeGreaterThan(24_000);
  expect(columns * rows).toBeLessThan(28_000);
});

it("the ruler's marks are round numbers within the picture", () => {
  expect(rulerMarks(15)).toEqual([0, 2, 4, 6, 8, 10, 12, 14]);
  expect(rulerMarks(60)).toEqual([0, 10, 20, 30, 40, 50]);
});

it("slow pictures lower the detail, fast ones raise it again, one slow picture does nothing", () => {
  const quality = new Quality();
  quality.judge(40);
  for (let i = 0; i < 20; i++) quality.judge(5);
  expect(quality.level).toBe(0);
  for (let i = 0; i < 60; i++) quality.judge(40);
  expect(quality.level).toBe(2);
  for (let i = 0; i < 300; i++) quality.judge(1);
  expect(quality.level).toBe(0);
});
