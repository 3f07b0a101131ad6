import type { Field } from "./fields.ts";
import { rounded } from "./number.ts";

const RAD_PER_DEG = Math.PI / 180;

/** Converts a value from one key of a pair to the other; undefined if there is no conversion. */
export function converted(from: Field, to: Field, value: unknown): number | undefined {
  if (typeof value !== "number") return undefined;
  if (from.unit === "rad" && to.unit === "deg") return rounded(value / RAD_PER_DEG, 5);
  if (from.unit === "deg" && to.unit === "rad") return rounded(value * RAD_PER_DEG, 5);
  if (from.sizes.length) return from.sizes[from.options.indexOf(value)];
  if (to.sizes.length) return to.options[nearest(to.sizes, value)] as number | undefined;
  return undefined;
}

function nearest(sizes: readonly number[], value: number): number {
  let best = 0;
  sizes.forEach((size, i) => {
    if (Math.abs(size - value) < Math.abs(sizes[best]! - value)) best = i;
  });
  return best;
}
