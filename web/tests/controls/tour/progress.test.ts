import { beforeEach, expect, it, vi } from "vitest";
import { Progress, tourDone } from "../../../src/controls/tour/progress.ts";
import { Source } from "../../../src/state/source.ts";
import type { LawCurve, MembraneEvent } from "../../../src/wire/messages.ts";
import { codeOf } from "../../../src/wire/ticks.ts";
import { batch } from "../../support/fill_history.ts";

const OUTSIDE = codeOf("phase", "outside");
const STICKING = codeOf("phase", "sticking");

let source: Source;
let progress: Progress;

/** Adds ticks with the tip outside, or inside with this force, N; then the tour looks at them. */
function ticks(count: number, inside: boolean, force = 0): void {
  const from = source.history.end;
  source.history.push(
    batch(from, count, 1, { phase: () => [inside ? STICKING : OUTSIDE], axial_force: () => [-force] }),
  );
  progress.follow(source);
}
function pop(drop = 0.6): void {
  const event = { kind: "event", what: "pop", membrane: 0, tick: source.history.end - 1, drop } as MembraneEvent;
  source.events.value = [...source.events.value, event];
}

beforeEach(() => {
  source = new Source("live", true, 1000);
  source.laws.value = [{ lower: [0, -1, -0.4], upper: [0, 0.4, 0.4] } as unknown as LawCurve];
  progress = new Progress();
  ticks(10, false);
});

it("each thing to do is done when the ticks show it", () => {
  expect(progress.done).toBe(0);
  ticks(5, true, 0.1);
  expect(progress.done).toBe(1);
  ticks(5, true, 0.49);
  expect(progress.done).toBe(1);
  ticks(5, true, 0.51);
  expect(progress.done).toBe(2);
  pop();
  ticks(5, true, 0.4);
  expect([progress.done, progress.fall]).toEqual([3, "force fell by 0.60 N"]);
  pop(0.25);
  ticks(5, true, 0.2);
  expect([progress.done, progress.fall]).toEqual([3, "force fell by 0.25 N"]);
  ticks(1, false);
  expect(progress.done).toBe(4);
});

it("a new run begins anew, until all is done once", () => {
  ticks(5, true, 0.9);
  pop();
  ticks(5, true, 0.4);
  expect(progress.done).toBe(3);
  source.history.clear(1);
  source.events.value = [];
  ticks(5, false);
  expect([progress.done, progress.fall, progress.ready]).toEqual([0, "", true]);
});

it("a single tick is enough, also between ticks that show nothing", () => {
  source.history.push(batch(10, 3, 1, { phase: (tick) => [tick === 11 ? STICKING : OUTSIDE] }));
  progress.follow(source);
  expect(progress.done).toBe(1);
});

it("a pop whose event comes after the tip is out again is not lost", () => {
  ticks(5, true, 0.9);
  pop();
  const event = source.events.value[0]!;
  source.events.value = [];
  ticks(5, false);
  expect(progress.done).toBe(2);
  source.events.value = [event];
  ticks(5, false);
  ticks(5, false);
  expect(progress.done).toBe(4);
});

it("a needle that is in tissue at the start must come out first", () => {
  progress = new Progress();
  ticks(5, true, 0.9);
  pop();
  expect([progress.ready, progress.done]).toEqual([false, 0]);
  ticks(5, true, 0.9);
  expect(progress.done).toBe(0);
  ticks(5, false);
  expect(progress.ready).toBe(true);
});

it("a new run goes on with what is left to do", () => {
  ticks(5, true, 0.9);
  expect(progress.done).toBe(2);
  source.history.clear(1);
  source.events.value = [];
  ticks(5, false);
  ticks(5, true, 0.1);
  pop();
  ticks(1, true, 0.1);
  expect(progress.done).toBe(3);
});

it("after a pop in the run nobody needs the tour, nor after an earlier visit that saw it", () => {
  vi.stubGlobal("document", { cookie: "" });
  expect(tourDone(source)).toBe(false);
  vi.stubGlobal("document", { cookie: "punctura_tour=seen" });
  expect(tourDone(source)).toBe(true);
  vi.stubGlobal("document", { cookie: "" });
  pop();
  expect(tourDone(source)).toBe(true);
  vi.unstubAllGlobals();
});
