/** Ticks beyond this time are left out, s: the browser gave the page no time, and a burst would be no hand's motion. */
const LONGEST_S = 0.1;

/** How many ticks are due, on a clock that a block of ticks catches up with. */
export class BlockClock {
  /** Ticks that were left out so far. */
  leftOut = 0;
  private done = 0;
  private began: number | null = null;

  /** rate: Hz. */
  constructor(private readonly rate: number) {}

  /** The number of ticks that are due now, on a clock in ms that never goes back. */
  due(now: number): number {
    this.began ??= now;
    const all = Math.floor((this.rate * (now - this.began)) / 1000) - this.done;
    const made = Math.min(all, Math.ceil(LONGEST_S * this.rate));
    this.done += all;
    this.leftOut += all - made;
    return made;
  }

  /** No tick is due until the next call of `due`, and none is left out: nobody looks at the page. */
  sleep(): void {
    this.began = null;
    this.done = 0;
  }
}
