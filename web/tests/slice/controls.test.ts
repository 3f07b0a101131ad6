import { expect, it } from "vitest";
import { wrapped } from "../../src/scene/probe.ts";
import { moved, Quality } from "../../src/slice/controls.ts";
import { frameOf, rasterOf, rulerMarks } from "../../src/slice/drawing.ts";

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
