import type { Field } from "./fields.ts";
import { rounded } from "./number.ts";

/** The values of a slider, and how its positions map to them. */
export interface Range {
  readonly low: number;
  readonly high: number;
  readonly scale: "linear" | "log" | "square";
}

export const SLIDER_STEPS = 400;

/** Upper ends for a value of 0, by unit, if the schema has no upper bound. */
const HIGH_FROM_ZERO: Readonly<Record<string, number>> = {
  mm: 2,
  N: 1,
  Hz: 1000,
  "N/mm": 1,
  "N s/mm": 0.005,
};

/**
 * The range of a field's slider. With two bounds, it is the range between them. Otherwise a positive number gets a
 * decade on either side, and a number that may be 0 gets 0 to four times its value, with the finest steps near 0.
 */
export function rangeAround(field: Field, value: number): Range {
  const low = field.least?.value;
  const high = field.most?.value;
  if (low !== undefined && high !== undefined) return { low, high, scale: "linear" };
  if (low === undefined) {
    const reach = value === 0 ? 1 : 2 * Math.abs(value);
    return { low: value - reach, high: value + reach, scale: "linear" };
  }
  if (field.least?.open && value > 0) {
    const decade = 10 ** Math.round(Math.log10(value));
    return { low: decade / 10, high: decade * 10, scale: "log" };
  }
  return { low, high: value > low ? niceAbove(4 * value) : (HIGH_FROM_ZERO[field.unit] ?? 1), scale: "square" };
}

/** The smallest of 1, 2, 5, 10, ... that is not below `value`. */
export function niceAbove(value: number): number {
  const decade = 10 ** Math.floor(Math.log10(value));
  for (const step of [1, 2, 5]) if (value <= step * decade * (1 + 1e-12)) return rounded(step * decade);
  return rounded(10 * decade);
}

export const within = (range: Range, value: number): boolean => value >= range.low && value <= range.high;

/** The slider's position for a value, 0 to SLIDER_STEPS. */
export function placeOf(range: Range, value: number): number {
  const { low, high, scale } = range;
  const bounded = Math.min(Math.max(value, low), high);
  const part =
    scale === "log"
      ? Math.log(bounded / low) / Math.log(high / low)
      : scale === "square"
        ? Math.sqrt((bounded - low) / (high - low))
        : (bounded - low) / (high - low);
  return Math.round(part * SLIDER_STEPS);
}

/** The value at a position of the slider, with three digits and inside the field's open bounds. */
export function valueAt(range: Range, place: number, field: Field): number {
  const part = place / SLIDER_STEPS;
  const { low, high, scale } = range;
  const raw =
    scale === "log" ? low * (high / low) ** part : low + (high - low) * (scale === "square" ? part * part : part);
  const value = rounded(raw);
  const nudge = (high - low) / (2 * SLIDER_STEPS);
  if (field.least?.open && value <= field.least.value) return rounded(field.least.value + nudge);
  if (field.most?.open && value >= field.most.value) return rounded(field.most.value - nudge);
  if (field.most && value > field.most.value) return field.most.value;
  return value;
}
