import { beforeEach, expect, it } from "vitest";
import { Fade } from "../../src/scene/fade.ts";
import { Quality } from "../../src/scene/quality.ts";

let clock = 0; // ms
beforeEach(() => {
  clock = 0;
});
const pictures = (quality: Quality, count: number, took: number): void => {
  for (let i = 0; i < count; i++) {
    clock += took;
    quality.step(clock, true, true);
  }
};
/** Animation frames while the needle stands still and its trail fades. took: ms for each frame. */
const fading = (quality: Quality, count: number, took: number): void => {
  const fade = new Fade();
  for (let i = 0; i < count; i++) {
    clock += took;
    const fades = fade.step(clock / 1e3, i === 0);
    quality.step(clock, fades && !quality.rests(clock, i === 0), true);
  }
};

it("late pictures get fewer pixels step by step, and the view says so", () => {
  const quality = new Quality(1);
  expect(quality.words()).toBe("");
  pictures(quality, 13, 60);
  expect(quality.ratio).toBeCloseTo(0.8);
  expect(quality.words()).toBe("Coarser while moving: 80 %");
  pictures(quality, 500, 60);
  expect(quality.ratio).toBe(0.8);
});

it("pictures that come in time stay sharp, and so do single late ones and an idle view", () => {
  const quality = new Quality(2);
  pictures(quality, 300, 30);
  for (let i = 0; i < 100; i++) {
    pictures(quality, 1, 90);
    pictures(quality, 4, 17);
  }
  pictures(quality, 100, 5000);
  expect(quality.ratio).toBe(2);
});

it("pictures of which some come late are coarser if they are fewer than 30 a second on average", () => {
  const mixed = (late: number, inTime: number): Quality => {
    const quality = new Quality(1);
    for (let i = 0; i < 60; i++) {
      pictures(quality, 1, late);
      pictures(quality, 3, inTime);
    }
    return quality;
  };
  expect(mixed(50, 33).ratio).toBeLessThan(1); // 27 a second
  expect(mixed(50, 26).ratio).toBe(1); // 31 a second
});

it("sharpness comes back when pictures come early, and waits twice as long after each failed attempt", () => {
  const quality = new Quality(1);
  pictures(quality, 13, 60);
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

it("a trail that fades asks for few pictures, and these are not late", () => {
  const quality = new Quality(2);
  for (const took of [7, 17, 33]) for (let i = 0; i < 50; i++) fading(quality, 2500 / took, took);
  expect(quality.words()).toBe("");
});

it("a picture is sharp 0.2 s after the last motion, while the trail still fades", () => {
  const quality = new Quality(1);
  expect(quality.rests(1000, true)).toBe(false);
  expect(quality.rests(1150, false)).toBe(false);
  expect(quality.rests(1200, false)).toBe(true);
  expect(quality.rests(1210, true)).toBe(false);
});

it("a picture between two frames takes until the frame after that which shows it", () => {
  const quality = new Quality(1);
  const drawnBetween = (took: number): void => {
    quality.step(clock, true, false);
    quality.step(clock + 1, false, true);
    clock += took;
  };
  for (let i = 0; i < 50; i++) drawnBetween(30);
  expect(quality.lowered).toBe(false);
  for (let i = 0; i < 14; i++) drawnBetween(60);
  expect(quality.lowered).toBe(true);
});

it("the wait for sharpness has an end, however many attempts failed", () => {
  const quality = new Quality(1);
  for (let i = 0; i < 20; i++) {
    pictures(quality, 13, 60);
    expect(quality.lowered).toBe(true);
    pictures(quality, 2000, 17);
    expect(quality.lowered).toBe(false);
  }
});
