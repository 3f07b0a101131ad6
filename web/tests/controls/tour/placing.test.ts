import { expect, test } from "vitest";
import { placed } from "../../../src/controls/tour/placing.ts";

const window = { width: 1440, height: 900 };
const size = { width: 320, height: 160 };

test("a popover stands beside its panel", () => {
  expect(placed({ left: 8, top: 66, width: 570, height: 490 }, size, window)).toMatchObject({
    side: "right",
    left: 590,
  });
  expect(placed({ left: 1090, top: 66, width: 340, height: 820 }, size, window)).toMatchObject({
    side: "left",
    left: 758,
  });
  expect(placed({ left: 8, top: 8, width: 1424, height: 300 }, size, window)).toMatchObject({
    side: "below",
    top: 320,
  });
});

test("without space it goes inside, and never outside the window", () => {
  const { left, top, side } = placed({ left: 0, top: 0, width: 360, height: 900 }, size, { width: 360, height: 640 });
  expect(side).toBe("inside");
  expect(left).toBeGreaterThanOrEqual(12);
  expect(left + size.width).toBeLessThanOrEqual(360);
  expect(top + size.height).toBeLessThanOrEqual(640);
});
