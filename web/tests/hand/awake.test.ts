import { afterEach, expect, it, vi } from "vitest";
import { tellAwake } from "../../src/hand/hand.ts";
import type { App } from "../../src/state/app.ts";

afterEach(() => vi.unstubAllGlobals());

it("a page that moves the hand of an exercise says so ten times a second, and a stalled one is silent", () => {
  let step: FrameRequestCallback = () => {};
  vi.stubGlobal("requestAnimationFrame", (next: FrameRequestCallback) => {
    step = next;
    return 1;
  });
  let words = 0;
  const app = {
    control: { value: { you: true } },
    hello: { value: { device: { simulated: true } } },
    exercise: { value: { running: true } },
    engine: { awake: () => words++ },
  };
  tellAwake(app as unknown as App);
  for (let now = 0; now < 1000; now += 20) step(now);
  expect(words).toBe(10);
  step(4000); // after 3 s without a frame
  expect(words).toBe(11);
  app.control.value.you = false;
  step(5000);
  app.control.value.you = true;
  app.exercise.value.running = false;
  step(6000);
  expect(words).toBe(11);
});
