import type { Source } from "../../state/source.ts";
import type { SceneView } from "../../wire/messages.ts";

/** An attempt along its time: s, m below the first surface, N on the hand. */
export interface Trace {
  readonly time: Float64Array;
  readonly depth: Float32Array;
  readonly force: Float32Array;
}

/** A layer by its depth below the first surface, m. */
export interface Layer {
  readonly name: string;
  readonly top: number;
  readonly bottom: number;
}

type Vector = ArrayLike<number>;
const dot = (a: Vector, b: Vector): number => a[0]! * b[0]! + a[1]! * b[1]! + a[2]! * b[2]!;

/** The whole of a source. Needs its scene. */
export function traceOf(source: Source): Trace {
  const { history } = source;
  const surface = source.scene.value?.membranes[0];
  const n = history.length;
  const trace = { time: new Float64Array(n), depth: new Float32Array(n), force: new Float32Array(n) };
  if (!surface) return trace;
  const offset = dot(surface.point, surface.inward_normal);
  for (let i = 0; i < n; i++) {
    const tick = history.first + i;
    trace.time[i] = history.timeOf(tick);
    trace.depth[i] = dot(history.row("tip", tick), surface.inward_normal) - offset;
    trace.force[i] = -dot(history.row("model_force", tick), history.row("axis", tick));
  }
  return trace;
}

/** The membranes of a scene below its first surface. */
export function layersOf(scene: SceneView): Layer[] {
  const first = scene.membranes[0];
  if (!first) return [];
  return scene.membranes.map(({ name, point, thickness }) => {
    const top = dot(point, first.inward_normal) - dot(first.point, first.inward_normal);
    return { name, top, bottom: top + thickness };
  });
}

/** The space between two of them; null where there is none. */
export function spaceBetween(layers: readonly Layer[], space: readonly number[]): Layer | null {
  const [behind, before] = [layers[space[0] ?? -1], layers[space[1] ?? -1]];
  return behind && before ? { name: "", top: behind.bottom, bottom: before.top } : null;
}

/**
 * A curve in as few points as a drawing of `columns` pixels can show: of each column its first, lowest, highest and last
 * value, in their order. Places without a number break the curve.
 */
export function envelope(
  x: ArrayLike<number>,
  y: ArrayLike<number>,
  from: number,
  to: number,
  columns: number,
): number[][] {
  const pieces: number[][] = [];
  let piece: number[] = [];
  const size = Math.max(Math.ceil((to - from) / columns), 1);
  const close = (): void => {
    if (piece.length) pieces.push(piece);
    piece = [];
  };
  for (let start = from; start < to; start += size) {
    const end = Math.min(start + size, to);
    let [low, high] = [start, start];
    let whole = true;
    for (let i = start; i < end; i++) {
      if (!Number.isFinite(y[i])) whole = false;
      else if (!(y[i]! >= y[low]!)) low = i;
      else if (!(y[i]! <= y[high]!)) high = i;
    }
    if (!whole) {
      close();
      continue;
    }
    const kept = [...new Set([start, low, high, end - 1])].sort((a, b) => a - b);
    for (const i of kept) piece.push(x[i]!, y[i]!);
  }
  close();
  return pieces;
}

/** The first index whose time is not before `time`. */
export function indexAt(time: ArrayLike<number>, when: number): number {
  let [low, high] = [0, time.length];
  while (low < high) {
    const middle = (low + high) >> 1;
    if (time[middle]! < when) low = middle + 1;
    else high = middle;
  }
  return low;
}
