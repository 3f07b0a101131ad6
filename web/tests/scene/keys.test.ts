import { afterEach, beforeEach, expect, it, vi } from "vitest";
import type { Hand } from "../../src/hand/hand.ts";
import { FIRM, type Thumb } from "../../src/hand/thumb.ts";
import type { OrbitCamera } from "../../src/scene/camera.ts";
import { viewKeys } from "../../src/scene/keys.ts";

let canvas: EventTarget;
let pushed: number[];
let moves: (readonly number[])[];
let pushes: number[];
let frame: FrameRequestCallback;
const hand = {
  run: 0,
  push: (depth: number) => pushed.push(depth),
  near: () => [0, 0, 1],
  moveBy: (way: readonly number[]) => moves.push(way),
};
const key = (type: string, name: string, more = {}): void => {
  canvas.dispatchEvent(Object.assign(new Event(type, { cancelable: true }), { key: name, ...more }));
};
const deep = (): number => pushed.reduce((sum, step) => sum + step, 0);

beforeEach(() => {
  [canvas, pushed, moves, pushes] = [new EventTarget(), [], [], []];
  hand.run = 0;
  vi.stubGlobal("requestAnimationFrame", (next: FrameRequestCallback) => {
    frame = next;
    return 1;
  });
  vi.spyOn(performance, "now").mockReturnValue(0);
  const thumb = { push: (_by: string, force: number) => pushes.push(force) };
  viewKeys(
    canvas as unknown as HTMLElement, hand as unknown as Hand, {} as OrbitCamera, () => {}, thumb as unknown as Thumb,
  ); // biome-ignore format: short
});
afterEach(() => {
  canvas.dispatchEvent(new Event("blur")); // its frames go on
  vi.unstubAllGlobals();
  vi.restoreAllMocks();
});

it("a tap is one step; a held key moves by time, whatever the keyboard repeats and whatever other keys do", () => {
  key("keydown", "ArrowDown");
  expect(deep()).toBeCloseTo(0.25e-3, 12);
  frame(250);
  expect(deep()).toBeCloseTo(0.25e-3, 12);
  key("keydown", " "); // the keyboard will not repeat the arrow
  for (let now = 10; now <= 1000; now += 10) frame(now);
  expect(deep()).toBeCloseTo(0.25e-3 + 7.5e-3, 9);
  expect(pushes).toEqual([FIRM]);
  key("keyup", "ArrowDown");
  frame(1400);
  expect(deep()).toBeCloseTo(0.25e-3 + 7.5e-3, 9);
  expect(pushes).toEqual([FIRM]); // the thumb goes on
  key("keydown", "ArrowUp");
  key("keydown", "ArrowUp", { repeat: true });
  key("keydown", "ArrowUp", { repeat: true });
  frame(200);
  expect(deep()).toBeCloseTo(7.5e-3 - 1.5e-3, 9);
});

it("a key that stays down moves by time after 0.4 s, also if the keyboard repeats nothing", () => {
  key("keydown", "ArrowDown");
  frame(400);
  expect(deep()).toBeCloseTo(0.25e-3, 12);
  frame(600);
  expect(deep()).toBeCloseTo(0.25e-3 + 1.5e-3, 9);
  key("keyup", "ArrowDown");
  frame(800);
  expect(deep()).toBeCloseTo(0.25e-3 + 1.5e-3, 9);
});

it("a page that stalled does not jump, and a view that loses the focus moves nothing", () => {
  key("keydown", "ArrowDown");
  key("keydown", "ArrowDown", { repeat: true });
  frame(5250);
  expect(deep()).toBeCloseTo(0.25e-3 * (1 + 0.25 * 30), 9);
  canvas.dispatchEvent(new Event("blur"));
  const before = deep();
  frame(5400);
  expect(deep()).toBe(before);
});

it("a key that was held when a new run began moves nothing until it is pressed anew", () => {
  key("keydown", "ArrowDown");
  key("keydown", "ArrowDown", { repeat: true });
  hand.run = 1;
  const before = deep();
  frame(500);
  key("keydown", "ArrowDown", { repeat: true });
  frame(600);
  expect(deep()).toBe(before);
  key("keydown", "ArrowDown");
  expect(deep()).toBeCloseTo(before + 0.25e-3, 12);
});

it("PageDown and PageUp move towards the user and back along the skin, with Shift four times as far", () => {
  key("keydown", "PageDown");
  key("keydown", "PageUp", { shiftKey: true });
  expect(moves).toEqual([[0, 0, 0.25e-3], [-0, -0, -1e-3]]); // biome-ignore format: short
});

it("a key that is still down when the focus comes back moves on", () => {
  key("keydown", "ArrowDown");
  canvas.dispatchEvent(new Event("blur"));
  key("keydown", "ArrowUp", { repeat: true }); // was pressed elsewhere
  key("keydown", "ArrowDown", { repeat: true });
  const before = deep();
  frame(100);
  expect(deep()).toBeCloseTo(before + 0.75e-3, 12);
});

it("Space pushes the plunger while it is held, and losing the focus lets go", () => {
  key("keydown", " ");
  key("keyup", " ");
  canvas.dispatchEvent(new Event("blur"));
  expect(pushes).toEqual([FIRM, 0, 0]);
});

it("with Command or another such key nothing is held: macOS sends no keyup then", () => {
  key("keydown", "ArrowDown");
  key("keydown", "ArrowDown", { repeat: true });
  key("keydown", " ");
  key("keydown", "Meta", { metaKey: true });
  const before = deep();
  frame(500);
  expect(deep()).toBe(before);
  expect(pushes.at(-1)).toBe(0);
});
