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

const SHRINK_BELOW = 0.55; // the range shrinks when the values use less than this share of it ...
const SHRINK_DELAY = 2; // ... for this long, s
const PADDING = 0.02; // share of the values' span that stays free at either end

/** An axis range that follows its values. It grows at once, to round numbers, and shrinks only after a delay. */
export class AutoRange {
  min = 0;
  max = 0;
  private smallSince = Number.POSITIVE_INFINITY;

  /** Takes in the values' extent at the time `now` (s). Returns whether the range changed. */
  follow(low: number, high: number, now: number): boolean {
    if (!(low <= high)) return false;
    const span = Math.max(high - low, 1e-9);
    const step = niceStep(span, 5) / 2;
    const min = Math.floor((low - PADDING * span) / step) * step;
    const max = Math.ceil((high + PADDING * span) / step) * step;
    const empty = this.max <= this.min;
    const small = !empty && high - low < SHRINK_BELOW * (this.max - this.min);
    if (!small) this.smallSince = Number.POSITIVE_INFINITY;
    else if (this.smallSince > now) this.smallSince = now;
    if (empty || now - this.smallSince > SHRINK_DELAY) return this.take(min, max);
    if (low < this.min || high > this.max) return this.take(Math.min(min, this.min), Math.max(max, this.max));
    return false;
  }

  forget(): void {
    this.min = this.max = 0;
  }

  private take(min: number, max: number): boolean {
    const changed = min !== this.min || max !== this.max;
    this.min = min;
    this.max = max;
    this.smallSince = Number.POSITIVE_INFINITY;
    return changed;
  }
}
