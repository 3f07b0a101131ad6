import { expect, it } from "vitest";
import type { Hand } from "../../src/hand/hand.ts";
import type { OrbitCamera } from "../../src/scene/camera.ts";
import { viewKeys } from "../../src/scene/keys.ts";

it("a key that was held when a new run began moves nothing until it is pressed anew", () => {
  const canvas = new EventTarget();
  const pushed: number[] = [];
  const hand = { run: 0, push: (depth: number) => pushed.push(depth) };
  viewKeys(canvas as unknown as HTMLElement, hand as unknown as Hand, {} as OrbitCamera, () => {});
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
