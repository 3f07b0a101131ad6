/** Pixels of the tissue's picture at each level, before it is scaled up. */
const LEVELS = [40_000, 22_000, 12_000] as const;

const SLOW_MS = 10; // a third of the time of a picture at 30 a second: the 3-D view needs the rest
const FAST_MS = 3.5;
const PATIENCE = 12; // pictures

/** Lowers the number of pixels while pictures take too long, and raises it again. */
export class Quality {
  level = 0;
  private slow = 0;
  private fast = 0;

  get pixels(): number {
    return LEVELS[this.level]!;
  }

  /** took: ms for the last picture. Returns whether the level changed. */
  judge(took: number): boolean {
    this.slow = took > SLOW_MS ? this.slow + 1 : Math.max(0, this.slow - 1);
    this.fast = took < FAST_MS ? this.fast + 1 : 0;
    if (this.slow >= PATIENCE && this.level < LEVELS.length - 1) this.level++;
    else if (this.fast >= 10 * PATIENCE && this.level > 0) this.level--;
    else return false;
    this.slow = 0;
    this.fast = 0;
    return true;
  }
}
