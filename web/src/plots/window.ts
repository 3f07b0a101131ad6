import { type History, tickAt } from "../state/history.ts";

/** The tick nearest to `time` (s); null if the history is empty. */
export function nearestTick(history: History, time: number): number | null {
  if (history.end === history.first) return null;
  const after = Math.min(tickAt(history, time), history.end - 1);
  const before = Math.max(after - 1, history.first);
  return time - history.timeOf(before) < history.timeOf(after) - time ? before : after;
}

/** A span of time, s, and the ticks in it. */
export class Window {
  from = 0;
  to = 1;
  first = 0;
  end = 0;

  /**
   * Shows the last `seconds` up to the shown tick. A shorter run fills the window from the left. A recording also
   * shows some time after the shown tick. The window moves in steps of `pixel` seconds, so that within a step the
   * drawn background stays valid.
   */
  follow(history: History, shown: number | null, seconds: number, live: boolean, pixel: number): void {
    const now = shown === null ? 0 : history.timeOf(shown);
    const begin = history.end > history.first ? history.timeOf(history.first) : 0;
    const last = history.end > history.first ? history.timeOf(history.end - 1) : 0;
    const to = live ? now : Math.min(last, now + seconds / 4);
    this.from = Math.max(Math.ceil(to / pixel) * pixel - seconds, begin);
    this.to = this.from + seconds;
    this.find(history);
  }

  set(history: History, from: number, to: number): void {
    this.from = from;
    this.to = to;
    this.find(history);
  }

  private find(history: History): void {
    // One more tick on either side, so that lines reach the edges.
    this.first = Math.max(history.first, tickAt(history, this.from) - 1);
    this.end = Math.min(history.end, tickAt(history, this.to) + 1);
  }
}

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
