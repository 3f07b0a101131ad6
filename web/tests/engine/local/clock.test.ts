import { expect, it } from "vitest";
import { BlockClock } from "../../../src/engine/local/clock.ts";

it("makes every tick of its rate, in blocks of any length", () => {
  const clock = new BlockClock(1600);
  let ticks = clock.due(50);
  for (let now = 50; now < 10_050; now += 7.3) ticks += clock.due(now);
  ticks += clock.due(10_050);
  expect(ticks).toBe(16_000);
  expect(clock.leftOut).toBe(0);
});

it("leaves out ticks after a long pause, and counts them", () => {
  const clock = new BlockClock(1600);
  clock.due(0);
  expect(clock.due(1000)).toBe(160);
  expect(clock.leftOut).toBe(1440);
  expect(clock.due(1010)).toBe(16);
  expect(clock.leftOut).toBe(1440);
});

it("counts nothing as left out while nobody looks at the page", () => {
  const clock = new BlockClock(1600);
  clock.due(0);
  expect(clock.due(10)).toBe(16);
  clock.sleep();
  expect(clock.due(60_000)).toBe(0);
  expect(clock.due(60_010)).toBe(16);
  expect(clock.leftOut).toBe(0);
});
