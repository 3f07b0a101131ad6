import { expect, it } from "vitest";
import type { Hand } from "../../src/hand/hand.ts";
import type { Thumb } from "../../src/hand/thumb.ts";
import type { OrbitCamera } from "../../src/scene/camera.ts";
import { viewKeys } from "../../src/scene/keys.ts";

it("a key that was held when a new run began moves nothing until it is pressed anew", () => {
  const canvas = new EventTarget();
  const pushed: number[] = [];
  const hand = { run: 0, push: (depth: number) => pushed.push(depth) };
  viewKeys(canvas as unknown as HTMLElement, hand as unknown as Hand, {} as OrbitCamera, () => {}, {} as Thumb);
  const press = (repeat: boolean): void => {
    canvas.dispatchEvent(Object.assign(new Event("keydown", { cancelable: true }), { key: "ArrowDown", repeat }));
  };
  press(false);
  press(true);
  expect(pushed).toHaveLength(2);
  hand.run = 1;
  press(true);
  press(true);
  expect(pushed).toHaveLength(2);
  press(false);
  press(true);
  expect(pushed).toHaveLength(4);
});

it("PageDown and PageUp move towards the user and back, with Shift four times as far", () => {
  const canvas = new EventTarget();
  const moves: (readonly number[])[] = [];
  const hand = { run: 0, moveBy: (way: readonly number[]) => moves.push(way) };
  viewKeys(canvas as unknown as HTMLElement, hand as unknown as Hand, {} as OrbitCamera, () => {}, {} as Thumb);
  for (const [key, shiftKey] of [["PageDown", false], ["PageUp", true]] as const) // biome-ignore format: short
    canvas.dispatchEvent(Object.assign(new Event("keydown", { cancelable: true }), { key, shiftKey }));
  expect(moves).toEqual([[0, 0, 0.25e-3], [0, 0, -1e-3]]); // biome-ignore format: short
});

it("Space pushes the plunger while it is held, and losing the focus lets go", () => {
  const canvas = new EventTarget();
  const pushes: number[] = [];
  const thumb = { push: (_by: string, force: number) => pushes.push(force) };
  viewKeys(
    canvas as unknown as HTMLElement, { run: 0 } as Hand, {} as OrbitCamera, () => {}, thumb as unknown as Thumb,
  ); // biome-ignore format: short
  const key = (type: string): void => {
    canvas.dispatchEvent(Object.assign(new Event(type, { cancelable: true }), { key: " " }));
  };
  key("keydown");
  key("keyup");
  canvas.dispatchEvent(new Event("blur"));
  expect(pushes).toEqual([4, 0, 0]);
});
