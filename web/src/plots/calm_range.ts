import { niceStep } from "./ticks.ts";

const PATIENCE = 2; // s for which the values must need less than this part of the range before it shrinks
const AIR = 0.02; // share of the values' span that stays free at either end
const MUCH_SMALLER = 0.55;

/** A range for an axis that follows its values without fidgeting: grows at once, to round numbers, and shrinks late. */
export class CalmRange {
  min = 0;
  max = 0;
  private smallSince = Number.POSITIVE_INFINITY;

  /** now: s. Whether the range is another one than before. */
  follow(low: number, high: number, now: number): boolean {
    if (!(low <= high)) return false;
    const span = Math.max(high - low, 1e-9);
    const step = niceStep(span, 5) / 2;
    const min = Math.floor((low - AIR * span) / step) * step;
    const max = Math.ceil((high + AIR * span) / step) * step;
    const empty = this.max <= this.min;
    const small = !empty && high - low < MUCH_SMALLER * (this.max - this.min);
    if (!small) this.smallSince = Number.POSITIVE_INFINITY;
    else if (this.smallSince > now) this.smallSince = now;
    if (empty || now - this.smallSince > PATIENCE) return this.take(min, max);
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
