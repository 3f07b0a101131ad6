export const SPEEDS = [0.1, 0.25, 0.5, 1, 2, 4] as const;

/** Where a run is being looked at, in ticks: it goes on with the time that it is told, never by itself. */
export class Playback {
  playing = false;
  speed = 1;
  private at: number;

  /** first, last: ticks; rate: ticks a second. */
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

  /** At the end it begins again from the first tick. */
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
  /** A tick, or some, to or fro; that pauses. */
  step(ticks: number): void {
    this.pause();
    this.seek(this.tick + ticks);
  }

  /** Lets `seconds` go by; stops at the end. Returns whether the tick has changed. */
  advance(seconds: number): boolean {
    if (!this.playing) return false;
    const before = this.tick;
    this.at = Math.min(this.at + seconds * this.speed * this.rate, this.last);
    if (this.at >= this.last) this.playing = false;
    return this.tick !== before;
  }

  /** The next of these ticks behind the present one, or the one before it; null where there is none. */
  neighbour(ticks: readonly number[], direction: 1 | -1): number | null {
    const ordered = [...ticks].sort((a, b) => direction * (a - b));
    return ordered.find((tick) => direction * (tick - this.tick) > 0) ?? null;
  }
}
