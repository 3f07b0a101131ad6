import type { Polyline } from "./polyline.ts";

/**
 * Decimates the line through `xs`, `ys` (pixels) for drawing. Consecutive points in one pixel column become at most
 * four: the first, the lowest, the highest and the last, in their order. The picture is the same to the pixel, so a
 * spike of one tick keeps its full height. NaN is a gap.
 */
export function decimate(xs: Float32Array, ys: Float32Array, from: number, to: number, out: Polyline): void {
  let first = -1;
  let last = -1;
  let low = -1;
  let high = -1;
  let column = 0;
  const flush = (): void => {
    if (first < 0) return;
    out.add(xs[first]!, ys[first]!);
    const earlier = Math.min(low, high);
    const later = Math.max(low, high);
    if (earlier > first && earlier < last) out.add(xs[earlier]!, ys[earlier]!);
    if (later > earlier && later > first && later < last) out.add(xs[later]!, ys[later]!);
    if (last > first) out.add(xs[last]!, ys[last]!);
    first = -1;
  };
  for (let i = from; i < to; i++) {
    const x = xs[i]!;
    const y = ys[i]!;
    if (Number.isNaN(x) || Number.isNaN(y)) {
      flush();
      out.gap();
      continue;
    }
    const here = Math.floor(x);
    if (first >= 0 && here === column) {
      last = i;
      if (y < ys[low]!) low = i;
      if (y > ys[high]!) high = i;
      continue;
    }
    flush();
    first = last = low = high = i;
    column = here;
  }
  flush();
}
