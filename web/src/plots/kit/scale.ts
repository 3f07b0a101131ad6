import { fixedNumber } from "../../format.ts";

/** Maps values to pixels, linearly or by their logarithms. */
export class Scale {
  min = 0;
  max = 1;
  /** The pixels of `min` and `max`. */
  from = 0;
  to = 1;
  log = false;

  set(min: number, max: number, from: number, to: number, log = false): void {
    this.min = min;
    this.max = max;
    this.from = from;
    this.to = to;
    this.log = log;
  }
  /** Pixels per unit of a linear scale. */
  get slope(): number {
    return (this.to - this.from) / (this.max - this.min);
  }
  px(value: number): number {
    const { min, max, from, to, log } = this;
    const share = log ? Math.log(value / min) / Math.log(max / min) : (value - min) / (max - min);
    return from + share * (to - from);
  }
  value(px: number): number {
    const { min, max, from, to, log } = this;
    const share = (px - from) / (to - from);
    return log ? min * (max / min) ** share : min + share * (max - min);
  }
}

/** A step of 1, 2 or 5 times a power of ten that divides `span` by about `wanted` lines. */
export function niceStep(span: number, wanted: number): number {
  const raw = span / Math.max(1, wanted);
  const power = 10 ** Math.floor(Math.log10(raw));
  const mantissa = raw / power;
  return (mantissa < 1.5 ? 1 : mantissa < 3.5 ? 2 : mantissa < 7.5 ? 5 : 10) * power;
}

/** Multiples of `step` from `min` to `max`, both included. */
export function ticks(min: number, max: number, step: number): number[] {
  const first = Math.ceil(min / step - 1e-9);
  const last = Math.floor(max / step + 1e-9);
  return Array.from({ length: Math.max(0, last - first + 1) }, (_, i) => (first + i) * step);
}

/** The value as text, with enough decimal places for steps of `step`. */
export function label(value: number, step: number): string {
  const places = Math.max(0, -Math.floor(Math.log10(step) + 1e-9));
  return fixedNumber(value, places);
}
