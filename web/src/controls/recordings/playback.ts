export const SPEEDS = [0.1, 0.25, 0.5, 1, 2, 4] as const;
/** For an excerpt around a pop: this many times slower than it was. */
export const SLOWDOWNS = [20, 50, 100] as const;
/** The same for the worst moment of an attempt. */
export const MOMENT_SLOWDOWNS = [3, 10, 30] as const;

/** The playback position in a recording, in ticks. It moves only by calls, never by itself. */
export class Playback {
  playing = false;
  speed = 1;
  private at: number;

  /** first, last: ticks; rate: ticks per second. */
  constructor(
    readonly first: number,
    readonly last: number,
    private readonly rate: number,
  ) {
    this.at = first;
  }

  /** The tick to show. */
  get tick(): number {
    return Math.floor(this.at);
  }
  get atEnd(): boolean {
    return this.tick >= this.last;
  }

  /** Starts playback; at the end, from the first tick again. */
  play(): void {
    if (this.atEnd) this.at = this.first;
    this.playing = this.last > this.first;
  }
  pause(): void {
    this.playing = false;
  }

  seek(tick: number): void {
    this.at = Math.min(Math.max(Math.round(tick), this.first), this.last);
  }
  /** Pauses, and moves by some ticks. */
  step(ticks: number): void {
    this.pause();
    this.seek(this.tick + ticks);
  }

  /** Plays `seconds`, and stops at the end. Returns whether the tick has changed. */
  advance(seconds: number): boolean {
    if (!this.playing) return false;
    const before = this.tick;
    this.at = Math.min(this.at + seconds * this.speed * this.rate, this.last);
    if (this.at >= this.last) this.playing = false;
    return this.tick !== before;
  }

  /** The nearest of these ticks after (1) or before (-1) the present one; null if there is none. */
  neighbour(ticks: readonly number[], direction: 1 | -1): number | null {
    const ordered = [...ticks].sort((a, b) => direction * (a - b));
    return ordered.find((tick) => direction * (tick - this.tick) > 0) ?? null;
  }
}
