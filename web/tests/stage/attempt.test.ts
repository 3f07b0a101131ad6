import { expect, it } from "vitest";
import { Attempt, wholeOf } from "../../src/stage/attempt.ts";
import { Source } from "../../src/state/source.ts";
import type { LawCurve, MembraneEvent, SceneView } from "../../src/wire/messages.ts";
import { codeOf } from "../../src/wire/ticks.ts";
import { batch } from "../support/fill_history.ts";

const [OUTSIDE, STICKING] = [codeOf("phase", "outside"), codeOf("phase", "sticking")];
const SKIN = { membranes: [{ point: [0, 0.001, 0], inward_normal: [0, -1, 0] }] } as unknown as SceneView;

function run(capacity: number): { source: Source; attempt: Attempt } {
  const source = new Source("live", true, capacity);
  source.scene.value = SKIN;
  return { source, attempt: new Attempt(source) };
}

/** Ticks at depths below the skin, mm, with this felt force, N; then the attempt takes them. */
function ticks({ source, attempt }: ReturnType<typeof run>, depths: number[], force: (mm: number) => number): void {
  const from = source.history.end;
  const depth = (tick: number): number => depths[tick - from]!;
  source.history.push(
    batch(from, depths.length, 1, {
      tip: (tick) => [0, 0.001 - depth(tick) / 1e3, 0],
      axis: () => [0, -1, 0],
      force: (tick) => [0, force(depth(tick)), 0],
      model_force: (tick) => [0, force(depth(tick)), 0],
      phase: (tick) => [depth(tick) > 0 ? STICKING : OUTSIDE],
    }),
  );
  attempt.follow();
}
const points = ({ path }: Attempt): [depth: number, force: number][] =>
  Array.from({ length: path.count }, (_, i) => [path.ys[i]!, path.xs[i]!]);
const down = (from: number, to: number, step = 0.01): number[] =>
  Array.from({ length: Math.round((to - from) / step) + 1 }, (_, i) => from + i * step);

it("the curve keeps the whole attempt, also what the history no longer has", () => {
  const made = run(64);
  for (let at = 0; at < 10; at++) ticks(made, down(at, at + 0.5), (mm) => 0.1 * mm);
  expect(made.source.history.first).toBeGreaterThan(400);
  const kept = points(made.attempt);
  expect(kept[0]![0]).toBeCloseTo(0, 5);
  for (const [depth, force] of kept) expect(force).toBeCloseTo(0.1 * depth, 5);
  for (let at = 0; at < 10; at++) expect(kept.some(([depth]) => Math.abs(depth - at - 0.25) < 0.02)).toBe(true);
});

it("a needle at rest adds nothing", () => {
  const made = run(1000);
  ticks(made, down(0, 1), () => 0.3);
  const before = made.attempt.path.count;
  ticks(
    made,
    Array.from({ length: 500 }, () => 1),
    () => 0.3,
  );
  expect([made.attempt.path.count, made.attempt.follow()]).toEqual([before, false]);
});

it("a very long attempt has a bounded number of points, and keeps its ends", () => {
  const made = run(3000);
  for (let k = 0; k < 24; k++) ticks(made, down(0, 20), (mm) => 0.05 * mm + 0.01 * k);
  expect(made.attempt.path.count).toBeLessThanOrEqual(20_001);
  const forces = points(made.attempt).map(([, force]) => force);
  expect(Math.max(...forces)).toBeCloseTo(1.23, 1);
  expect(Math.min(...forces)).toBeCloseTo(0, 1);
});

it("a pop stands where the tip was, with the force before it, also if its event comes before its tick", () => {
  const made = run(1000);
  const event = { kind: "event", what: "pop", membrane: 0, tick: 30, drop: 0.3 } as MembraneEvent;
  made.source.events.value = [event];
  ticks(made, down(0, 0.2), (mm) => mm);
  expect(made.attempt.pops).toEqual([]);
  ticks(made, down(0.21, 0.5), (mm) => (mm > 0.295 ? 0.1 : mm));
  const [pop] = made.attempt.pops;
  expect(pop?.event).toBe(event);
  expect(pop?.depth).toBeCloseTo(0.3, 4);
  expect(pop?.force).toBeCloseTo(0.29, 4);
});

it("a drop that is not seen in the curve has no mark", () => {
  const made = run(1000);
  made.source.laws.value = [{ lower: [-2] }] as unknown as LawCurve[];
  const pop = (tick: number, drop: number) =>
    ({ kind: "event", what: "pop", membrane: 0, tick, drop }) as MembraneEvent;
  made.source.events.value = [pop(10, -0.09), pop(20, -0.11)];
  ticks(made, down(0, 0.5), () => 1);
  expect(made.attempt.pops.map(({ event }) => event.tick)).toEqual([20]);
});

it("again begins anew, once the needle is out; and so does a new run", () => {
  const made = run(1000);
  ticks(made, down(0, 1), () => 0.3);
  made.attempt.begin();
  ticks(made, down(0.5, 1).reverse(), () => -0.2);
  expect(made.attempt.path.count).toBe(0);
  ticks(made, [-1, -0.5, ...down(0.1, 1)], () => 0.4);
  expect(points(made.attempt).every(([, force]) => Math.abs(force - 0.4) < 1e-6)).toBe(true);
  expect(made.attempt.deepest).toBeCloseTo(1, 5);
  made.source.history.clear(1);
  ticks(made, down(0, 0.1), () => 0.1);
  expect(made.attempt.deepest).toBeCloseTo(0.1, 5);
  expect(points(made.attempt).every(([depth]) => depth < 0.11)).toBe(true);
});

it("a moment of a recording has the curve of the recording, and a pop that of its run", () => {
  const { source } = run(8);
  const part = { of: source, tick: 0, first: 0, last: 1 };
  const excerpt = (event: MembraneEvent | null): Source => new Source("", false, source.history, { ...part, event });
  const moment = excerpt(null);
  expect(wholeOf(moment)).toBe(moment);
  expect(wholeOf(excerpt({ what: "pop", tick: 0 } as MembraneEvent))).toBe(source);
  expect(wholeOf(source)).toBe(source);
});
