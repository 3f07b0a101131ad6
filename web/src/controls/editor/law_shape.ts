import type { LawCurve } from "../../wire/messages.ts";
import { niceAbove } from "./range.ts";

/** The ends of the drawing's axes, m and N. */
export interface Extent {
  readonly depth: number;
  readonly least: number;
  readonly most: number;
}

const SHRINK = 0.35; // an axis shrinks if the curve fills less than this share of it

/** The axes for a law. They stay while the curve fills enough of them, so that a drag moves the curve, not the axes. */
export function extentFor(law: LawCurve, now: Extent | null): Extent {
  const deepest = Math.max(law.through * 1.25, 1e-6);
  const top = Math.max(...law.upper, 1e-3);
  const bottom = Math.min(...law.lower, 0);
  const depth = now && deepest <= now.depth && deepest > SHRINK * now.depth ? now.depth : niceAbove(deepest);
  const most = now && top <= now.most && top > SHRINK * now.most ? now.most : fine(top * 1.08);
  const least =
    now && bottom >= now.least && bottom < SHRINK * now.least ? now.least : -fine(-bottom * 1.08 || most / 8);
  return { depth, least, most };
}

/** The smallest of 1, 1.5, 2, 3, 4, 5, 6, 8 times a power of ten that is not below `value`. */
function fine(value: number): number {
  const decade = 10 ** Math.floor(Math.log10(value));
  for (const step of [1, 1.5, 2, 3, 4, 5, 6, 8])
    if (value <= step * decade) return Number((step * decade).toPrecision(3));
  return 10 * decade;
}

export type Place = (depth: number, force: number) => readonly [x: number, y: number];

/** Maps depth and force to a box with its upper left corner at (left, top). */
export function placing(extent: Extent, left: number, top: number, width: number, height: number): Place {
  const span = extent.most - extent.least;
  return (depth, force) => [left + (depth / extent.depth) * width, top + ((extent.most - force) / span) * height];
}

/** An SVG path through a curve, extended at its last force to the end of the axis. */
export function curvePath(depth: readonly number[], force: readonly number[], place: Place, end: number): string {
  const points = depth.map((d, i) => [d, force[i] ?? 0] as const).filter(([d]) => d >= 0 && d <= end);
  const last = points.at(-1);
  if (!last) return "";
  return `M${[...points, [end, last[1]] as const].map(([d, f]) => write(place(d, f))).join("L")}`;
}

/** The closed shape between the two edges of the band. */
export function bandPath(law: LawCurve, place: Place, end: number): string {
  const upper = curvePath(law.depth, law.upper, place, end);
  const lower = curvePath(law.depth, law.lower, place, end).slice(1).split("L").reverse().join("L");
  return upper && `${upper}L${lower}Z`;
}

const write = ([x, y]: readonly [number, number]): string => `${x.toFixed(1)},${y.toFixed(1)}`;

/** Three to six round numbers along an axis. */
export function ticksOf(low: number, high: number): number[] {
  const step = niceAbove((high - low) / 5);
  const first = Math.ceil(low / step - 1e-9);
  return Array.from({ length: Math.floor(high / step + 1e-9) - first + 1 }, (_, i) =>
    Number(((first + i) * step).toPrecision(6)),
  );
}
