import { niceStep } from "./scale.ts";

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
