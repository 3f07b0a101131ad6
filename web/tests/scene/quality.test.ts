import { expect, it } from "vitest";
import { Quality } from "../../src/scene/quality.ts";

const pictures = (quality: Quality, count: number, took: number): void => {
  for (let i = 0; i < count; i++) quality.watch(took);
};

it("late pictures get fewer pixels step by step, and the view says so", () => {
  const quality = new Quality(1);
  expect(quality.words()).toBe("");
  pictures(quality, 12, 60);
  expect(quality.ratio).toBeCloseTo(0.8);
  expect(quality.words()).toBe("Coarser while moving: 80 %");
  pictures(quality, 500, 60);
  expect(quality.ratio).toBe(0.6);
});

it("pictures that come in time stay sharp, and so do single late ones and an idle view", () => {
  const quality = new Quality(2);
  pictures(quality, 300, 30);
  for (let i = 0; i < 100; i++) {
    quality.watch(90);
    pictures(quality, 3, 17);
  }
  pictures(quality, 100, 5000);
  expect(quality.ratio).toBe(2);
});

it("sharpness comes back when pictures come early, and waits twice as long after each failed attempt", () => {
  const quality = new Quality(1);
  pictures(quality, 12, 60);
  pictures(quality, 119, 17);
  expect(quality.lowered).toBe(true);
  pictures(quality, 1, 17);
  expect(quality.ratio).toBe(1);
  expect(quality.words()).toBe("");
  pictures(quality, 12, 60);
  pictures(quality, 200, 17);
  expect(quality.lowered).toBe(true);
  pictures(quality, 40, 17);
  expect(quality.lowered).toBe(false);
});

it("a screen with few pixels is never coarser than it already is", () => {
  const quality = new Quality(0.5);
  pictures(quality, 100, 100);
  expect(quality.ratio).toBe(0.5);
  expect(quality.words()).toBe("");
});
