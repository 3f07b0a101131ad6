import { expect, test } from "vitest";
import { thinned } from "../../src/scene/paper.ts";

test("the first picture has every eighth pixel, also at the borders", () => {
  const [width, height] = [20, 9];
  const pixels = Uint8Array.from({ length: 4 * width * height }, (_, i) => Math.floor(i / 4) % 256);
  const small = thinned({ pixels, width, height } as never, 8);
  expect([small.width, small.height]).toEqual([3, 2]);
  expect([...small.data].filter((_, i) => i % 4 === 0)).toEqual([0, 8, 16, 160, 168, 176]);
});
