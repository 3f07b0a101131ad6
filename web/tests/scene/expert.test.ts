import { expect, test } from "vitest";
import { poseBeside } from "../../src/scene/expert.ts";
import type { Source } from "../../src/state/source.ts";

/** A run at 10 Hz whose tip is at its tick number, in m. */
const run = (touch: number | null, ticks = 100, live = false): Source =>
  ({
    live,
    scene: { value: { rate: 10 } },
    events: { value: touch === null ? [] : [{ what: "touch", time: touch }] },
    history: {
      first: 0,
      end: ticks,
      timeOf: (tick: number) => tick / 10,
      row: (name: string, tick: number) => Float32Array.from(name === "tip" ? [0, tick, 0] : [0, -1, 0]),
    },
  }) as unknown as Source;

test("the second needle is where it was as long after its own first contact", () => {
  expect(poseBeside(run(2), run(5), 30)?.position).toEqual([0, 60, 0]); // 1 s after the contact
  expect(poseBeside(run(5), run(2), 30)?.position).toEqual([0, 0, 0]); // 2 s before it
});

test("there is no second needle without a contact, beyond the end of its run, and beside a live run", () => {
  expect(poseBeside(run(2), null, 30)).toBeNull();
  expect(poseBeside(run(null), run(5), 30)).toBeNull();
  expect(poseBeside(run(2), run(null), 30)).toBeNull();
  expect(poseBeside(run(2), run(5), 80)).toBeNull();
  expect(poseBeside(run(2, 100, true), run(5), 30)).toBeNull();
});
