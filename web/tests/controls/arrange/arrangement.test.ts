import { expect, test } from "vitest";
import {
  Arrangements,
  DEFAULT,
  PANELS,
  parse,
  swapped,
  within,
  written,
} from "../../../src/controls/arrange/arrangement.ts";

/** Keeps one cookie, as a browser does. */
const jar = (): { cookie: string } => {
  let kept = "";
  return {
    get cookie() {
      return kept;
    },
    set cookie(text) {
      kept = text.split(";")[0]!;
    },
  };
};

test("sizes, places and the projector are kept, and a reset brings the default back", () => {
  const place = jar();
  const first = new Arrangements(place);
  first.set({ left: 0.3, side: 400, projector: true });
  first.swap("view", "time-plots");
  const second = new Arrangements(place);
  expect(second.now.value).toEqual({
    left: 0.3, top: DEFAULT.top, side: 400, projector: true,
    order: ["time-plots", "force-depth", "phases", "view"],
  }); // biome-ignore format: short
  second.toggle("view");
  second.reset();
  expect(new Arrangements(place).now.value).toEqual(DEFAULT);
  expect(second.maximised.value).toBeNull();
});

test("what is stored may be wrong: then it is the default", () => {
  for (const text of [null, "", "7", "535_600_344_0123", "535_600_344_0123_2", "x_600_344_0123_0"])
    expect(parse(text)).toEqual(DEFAULT);
  expect(parse("9000_600_1_0123_1")).toMatchObject({ left: 0.8, side: 280, projector: true });
  expect(parse("535_600_344_0012_0").order).toEqual(PANELS);
  expect(parse(written(DEFAULT))).toEqual(DEFAULT);
});

test("two panels swap, the others stay", () => {
  expect(swapped(DEFAULT, "view", "phases").order).toEqual(["phases", "force-depth", "view", "time-plots"]);
});

test("a size stays in its range", () => {
  expect([within("left", 0), within("top", 2), within("side", 300)]).toEqual([0.2, 0.85, 300]);
});
