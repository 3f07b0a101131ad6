import type { Spread } from "../wire/messages.ts";

/** A bar of a histogram with a logarithmic time axis, as shares of the box. */
export interface Bar {
  readonly left: number;
  readonly width: number;
  readonly height: number;
  /** s */
  readonly from: number;
  readonly to: number;
  readonly count: number;
}

/** Position of a time between two others on a logarithmic axis, 0 to 1. */
export const logPlace = (time: number, from: number, to: number): number =>
  Math.min(1, Math.max(0, Math.log(time / from) / Math.log(to / from)));

/**
 * The bars of a distribution between `from` and `to` (s). Heights are logarithmic too, so that one late tick in a
 * million is visible: a count of one is a tenth of the box. Bins beyond the ends are drawn at the ends.
 */
export function bars({ edges, counts }: Spread, from: number, to: number): Bar[] {
  const tallest = Math.log10(counts.reduce((most, count) => Math.max(most, count), 1));
  const made: Bar[] = [];
  counts.forEach((count, i) => {
    if (count <= 0) return;
    const [low, high] = [edges[i]!, edges[i + 1] ?? edges[i]!];
    const left = logPlace(Math.max(low, 1e-12), from, to);
    const right = logPlace(Math.max(high, 1e-12), from, to);
    const height = tallest > 0 ? 0.1 + (0.9 * Math.log10(count)) / tallest : 1;
    made.push({
      left: Math.min(left, 0.995),
      width: Math.max(right - left, 0.005),
      height,
      from: low,
      to: high,
      count,
    });
  });
  return made;
}
