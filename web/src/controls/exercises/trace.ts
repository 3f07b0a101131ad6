import type { ExerciseOverview, MembraneView, RecordingTrace } from "../../wire/messages.ts";

/** The curves of an attempt: time (s), depth of the point below the first surface (m), force (N); NaN is a gap. */
export interface Trace {
  readonly time: Float64Array;
  readonly depth: Float64Array;
  readonly force: Float64Array;
  /** How far the end of the slanted face is above the point, m; 0 if the depth is not the judged one. */
  readonly tip: number;
}

/** A layer's top and bottom below the first surface, m. The bottom is infinite for a space without an end. */
export interface Layer {
  readonly name: string;
  readonly top: number;
  readonly bottom: number;
}

type Vector = ArrayLike<number>;
const dot = (a: Vector, b: Vector): number => a[0]! * b[0]! + a[1]! * b[1]! + a[2]! * b[2]!;

export function traceOf({ time, depth, force, tip }: RecordingTrace): Trace {
  const numbers = (values: readonly (number | null)[]): Float64Array =>
    Float64Array.from(values, (value) => value ?? Number.NaN);
  return { time: numbers(time), depth: numbers(depth), force: numbers(force), tip };
}

/** The membranes of a scene below its first surface. */
export function layersOf(membranes: readonly MembraneView[]): Layer[] {
  const first = membranes[0];
  if (!first) return [];
  return membranes.map(({ name, point, thickness }) => {
    const top = dot(point, first.inward_normal) - dot(first.point, first.inward_normal);
    return { name, top, bottom: top + thickness };
  });
}

/** The part of the space that the exercise asks to reach; null if the scene does not have its first membrane. */
export function spaceOf(
  layers: readonly Layer[],
  exercise: Pick<ExerciseOverview, "space" | "space_to" | "goal_from">,
): Layer | null {
  const [behind, before] = exercise.space.map((place) => layers[place]);
  if (!behind) return null;
  const end = exercise.space_to === null ? Number.POSITIVE_INFINITY : behind.bottom + exercise.space_to;
  return {
    name: "",
    top: behind.bottom + exercise.goal_from,
    bottom: Math.min(end, before?.top ?? Number.POSITIVE_INFINITY),
  };
}

/** The first index with a time not before `when`. */
export function indexAt(time: ArrayLike<number>, when: number): number {
  let [low, high] = [0, time.length];
  while (low < high) {
    const middle = (low + high) >> 1;
    if (time[middle]! < when) low = middle + 1;
    else high = middle;
  }
  return low;
}
