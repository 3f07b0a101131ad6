const SPAN = 3; // s: the rate is measured over this time

/** Measures ticks per second from occasional counts of ticks. */
export class RateMeter {
  private readonly seen: Array<readonly [time: number, ticks: number]> = [];

  /** Adds a count at `time` (s). Returns the recent rate, Hz; null until there are two counts. */
  add(time: number, ticks: number): number | null {
    const last = this.seen.at(-1);
    if (last && ticks < last[1]) this.seen.length = 0; // another run
    this.seen.push([time, ticks]);
    while (this.seen.length > 2 && time - this.seen[0]![0] > SPAN) this.seen.shift();
    const [begin, count] = this.seen[0]!;
    return time > begin ? (ticks - count) / (time - begin) : null;
  }
}
