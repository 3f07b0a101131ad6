import { expect, test } from "vitest";
import { Playback } from "../../../src/controls/recordings/playback.ts";

test("it goes on with the time at its speed, and stops at the end", () => {
  const playback = new Playback(100, 1700, 1600);
  expect(playback.advance(1)).toBe(false);
  playback.play();
  playback.speed = 0.5;
  expect(playback.advance(0.5)).toBe(true);
  expect(playback.tick).toBe(500);
  playback.speed = 4;
  playback.advance(10);
  expect([playback.tick, playback.playing, playback.atEnd]).toEqual([1700, false, true]);
  playback.play();
  expect(playback.tick).toBe(100);
});

test("slow speeds lose no fraction of a tick", () => {
  const playback = new Playback(0, 1000, 1600);
  playback.play();
  playback.speed = 0.1;
  for (let i = 0; i < 60; i++) playback.advance(1 / 60);
  expect(playback.tick).toBeGreaterThanOrEqual(159);
  expect(playback.tick).toBeLessThanOrEqual(160);
});

test("stepping pauses, and stays within", () => {
  const playback = new Playback(0, 10, 1600);
  playback.play();
  playback.step(3);
  expect([playback.tick, playback.playing]).toEqual([3, false]);
  playback.step(-9);
  expect(playback.tick).toBe(0);
  playback.seek(99);
  expect(playback.tick).toBe(10);
});

test("the events around are found", () => {
  const playback = new Playback(0, 100, 1600);
  playback.seek(50);
  expect(playback.neighbour([10, 50, 70, 30, 90], 1)).toBe(70);
  expect(playback.neighbour([10, 50, 70, 30, 90], -1)).toBe(30);
  expect(playback.neighbour([50], 1)).toBeNull();
});

test("a run of one tick does not play", () => {
  const playback = new Playback(5, 5, 1600);
  playback.play();
  expect(playback.playing).toBe(false);
});
