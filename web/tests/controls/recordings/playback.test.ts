import { expect, test } from "vitest";
import { Playback } from "../../../src/controls/recordings/playback.ts";
import { bytesText, countText, dateText, eventText, lengthText } from "../../../src/controls/recordings/words.ts";

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

test("lengths, bytes and counts as people read them", () => {
  expect([lengthText(12.44), lengthText(185)]).toEqual(["12.4 s", "3 min 05 s"]);
  expect(bytesText(3.14e6, 12.4e6)).toBe("3.1 of 12.4 MB");
  expect(bytesText(500, 2000)).toBe("0.5 of 2.0 kB");
  expect(countText(19680)).toBe("19\u202f680");
  expect(countText(0)).toBe("0");
});

test("a date says its year where it is another one", () => {
  const now = new Date("2026-11-21T18:00:00Z");
  expect(dateText("2026-11-21T17:04:00Z", now)).toMatch(/^21 Nov.* 17:04$/);
  expect(dateText("2025-11-21T17:04:00Z", now)).toContain("2025");
  expect(dateText("", now)).toBe("");
});

test("an event in words", () => {
  const event = {
    kind: "event", what: "pop", membrane: 0, name: "skin", tick: 1, time: 1.204, depth: 0,
    force_before: 0.5, force_after: 0.19, drop: 0.31,
  } as const; // biome-ignore format: a record
  expect(eventText(event)).toBe("1.204 s: pop through skin, 0.31 N less");
});
