const SPAN = 3; // s over which the rate is taken

/** Ticks a second, from counts of ticks that come now and then. */
export class RateMeter {
  private readonly seen: Array<readonly [time: number, ticks: number]> = [];

  /** time: s. The rate over the last while, Hz; null until there are two counts. */
  add(time: number, ticks: number): number | null {
    const last = this.seen.at(-1);
    if (last && ticks < last[1]) this.seen.length = 0; // another run
    this.seen.push([time, ticks]);
    while (this.seen.length > 2 && time - this.seen[0]![0] > SPAN) this.seen.shift();
    const [begin, count] = this.seen[0]!;
    return time > begin ? (ticks - count) / (time - begin) : null;
  }
}
