import type { Window } from "./window.ts";

const WHOLE = 1e-3; // px

/**
 * What a layer of curves against time shows. While only ticks are added and the window moves by whole pixels, the layer
 * is moved, and only its last part is drawn again.
 */
export class Scrolled {
  private key = "";
  private from = 0;
  /** The ticks before this one are drawn. */
  end = 0;

  /**
   * Takes a new window. key: all else that the layer depends on. perSecond: pixels of the layer per second. Returns how
   * many pixels the layer moves to the left; null if all must be drawn again.
   */
  step(key: string, window: Window, perSecond: number): number | null {
    const far = (window.from - this.from) * perSecond;
    const pixels = Math.round(far);
    const now = `${key} ${perSecond.toFixed(6)}`;
    const same = now === this.key && window.first < this.end && window.end >= this.end;
    this.key = now;
    this.from = window.from;
    return same && pixels >= 0 && Math.abs(far - pixels) < WHOLE ? pixels : null;
  }
}
