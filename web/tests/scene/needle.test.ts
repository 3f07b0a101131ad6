import { Color } from "three";
import { afterAll, expect, it, vi } from "vitest";
import { Moment, OUTSIDE } from "../../src/scene/moment.ts";
import { Needle } from "../../src/scene/needle.ts";
import type { Theme } from "../../src/scene/theme.ts";
import { Source } from "../../src/state/source.ts";
import { codeOf } from "../../src/wire/ticks.ts";
import { batch } from "../support/fill_history.ts";
import { plainScene } from "../support/plain_scene.ts";

vi.stubGlobal("document", { createElement: () => ({ getContext: () => null }) }); // for the picture of steel
afterAll(() => void vi.unstubAllGlobals());

const INSIDE = codeOf("phase", "sliding_in");
const theme = { dark: false, watch: (act: () => void) => act(), color: () => new Color("red") } as unknown as Theme;

it("a replay that begins after the flash-back has its blood in the hub, and one before it has none", () => {
  const source = new Source("recording", false, 5000);
  source.laws.value = plainScene.laws;
  // In the vein from 1 s to 3 s, then behind it.
  source.history.push(
    batch(0, 4000, 3, {
      axis: () => [0, -1, 0],
      depth: () => [0.009, 0.004, 0.0005],
      phase: (tick) => [INSIDE, tick < 1000 ? OUTSIDE : INSIDE, tick < 3000 ? OUTSIDE : INSIDE],
    }),
  );
  const bloodAt = (...ticks: number[]): number => {
    const needle = new Needle(theme);
    for (const tick of ticks) {
      const moment = new Moment();
      source.cursor.value = tick;
      moment.read(source);
      needle.follow(source, moment, { ...plainScene, rate: 1000 });
    }
    return needle.state.blood;
  };
  expect(bloodAt(3100)).toBeGreaterThan(0.85);
  expect(bloodAt(900)).toBe(0);
  expect(bloodAt(3100, 900)).toBe(0);
  expect(bloodAt(3990)).toBeLessThan(bloodAt(3100));
});

it("a frame that comes late does not change the picture of a needle at rest", () => {
  const source = new Source("live", false, 5000);
  source.history.push(batch(0, 4000, 3, { axis: () => [0, -1, 0], phase: () => [OUTSIDE, OUTSIDE, OUTSIDE] }));
  const needle = new Needle(theme);
  const follows = [1000, 3000].map((tick) => {
    const moment = new Moment();
    moment.read(source, tick);
    return needle.follow(source, moment, { ...plainScene, rate: 1000 });
  });
  expect(follows.at(-1)).toBe(false);
});
