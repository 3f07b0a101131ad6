import { expect, it } from "vitest";
import { Rest } from "../../src/plots/rest.ts";
import { Plots } from "../../src/plots/shared.ts";
import type { App } from "../../src/state/app.ts";
import { Signal } from "../../src/state/signal.ts";
import { Source } from "../../src/state/source.ts";
import type { SceneView } from "../../src/wire/messages.ts";
import { batch } from "../support/fill_history.ts";

/** Adds so many ticks at this depth, m. */
const rest = (source: Source, count: number, depth: number): void =>
  source.history.push(batch(source.history.end, count, 1, { depth: () => [depth] }));

it("a run rests while no value changes so that it can be seen, and a slow drift is seen", () => {
  const source = new Source("live", true, 1000);
  const look = new Rest();
  rest(source, 100, 0);
  expect(look.since(source.history, 1)).toBe(true);
  rest(source, 100, 1e-5);
  expect(look.since(source.history, 100)).toBe(true);
  for (let k = 2; k < 5; k++) rest(source, 10, k * 1e-5);
  expect(look.since(source.history, 200)).toBe(false);
  expect(look.since(source.history, 230)).toBe(true);
  source.history.clear(1);
  rest(source, 1, 0);
  expect(look.since(source.history, 0)).toBe(false);
});

it("the plots' window stands still while the live run rests, moves once a second, and at once with the needle", () => {
  const source = new Source("live", true, 10_000);
  source.scene.value = { rate: 1000 } as SceneView;
  const plots = new Plots({ source: new Signal(source) } as unknown as App);
  const ends = new Set<number>();
  for (let k = 0; k < 200; k++) {
    rest(source, 16, 0); // 3.2 s, 16 ms each
    ends.add(plots.update().end);
  }
  expect(ends.size).toBeLessThanOrEqual(5);
  rest(source, 16, 1e-3);
  expect(plots.update().end).toBe(source.history.end);
});
