import { afterEach, beforeEach, expect, it, vi } from "vitest";
import { busy, everyFrame, ticksCame, turns } from "../src/frames.ts";

let asked: FrameRequestCallback | null = null;
let ends: (() => void)[] = [];
let drawn: [now: number, painted: boolean][] = [];

beforeEach(() => {
  drawn = [];
  vi.stubGlobal("requestAnimationFrame", (step: FrameRequestCallback) => {
    asked = step;
    return 1;
  });
  vi.stubGlobal("cancelAnimationFrame", () => {
    asked = null;
  });
});
afterEach(() => {
  for (const end of ends) end();
  ends = [];
  vi.unstubAllGlobals();
});

const watch = (): void => {
  ends.push(everyFrame((now, painted) => drawn.push([now, painted])));
};
/** The browser begins an animation frame. */
const frame = (now: number): void => asked?.(now);
/** Time for the messages that wait. */
const messages = (): Promise<void> => new Promise((done) => setTimeout(done));

it("after a frame without ticks, those that come next are drawn at once and not in the next frame", async () => {
  watch();
  frame(1);
  ticksCame();
  await vi.waitUntil(() => drawn.length > 1);
  expect(drawn.map(([, painted]) => painted)).toEqual([true, false]);
});

it("a frame with ticks, and one without any to come, is one picture", async () => {
  watch();
  ticksCame();
  frame(1);
  await messages();
  frame(2);
  await messages();
  expect(drawn).toEqual([
    [1, true],
    [2, true],
  ]);
});

it("when nobody draws any more, no frame is asked for", () => {
  watch();
  watch();
  frame(1);
  expect(drawn).toHaveLength(2);
  for (const end of ends) end();
  expect(asked).toBeNull();
});

it("while pictures come late, parts that can wait take turns; in time again, each is always drawn", () => {
  const had = [0, 0];
  const parts = [turns(), turns()];
  ends.push(
    everyFrame((now) => {
      parts.forEach((turn, i) => {
        if (turn(now)) had[i]!++;
      });
    }),
  );
  let now = 0;
  const run = (pictures: number, each: number): void => {
    had.fill(0);
    for (let i = 0; i < pictures; i++) {
      now += each;
      ticksCame();
      frame(now);
    }
  };
  run(100, 16);
  expect(busy()).toBe(false);
  expect(had).toEqual([100, 100]);
  run(100, 40);
  expect(busy()).toBe(true);
  run(30, 40);
  expect(had[0]! + had[1]!).toBeLessThanOrEqual(30);
  for (const times of had) expect(times).toBeGreaterThanOrEqual(14);
  run(30, 80);
  for (const times of had) expect(times).toBe(15);
  run(40, 16);
  run(20, 16);
  expect(had).toEqual([20, 20]);
});
