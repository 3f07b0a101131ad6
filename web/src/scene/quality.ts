const LATE_MS = 40; // a picture that takes longer than this is late: fewer than 25 a second
const QUICK_MS = 22;
const LATE_PICTURES = 12;
const QUICK_PICTURES = 120;
const MOST_PATIENCE = 8 * QUICK_PICTURES;
const STEP = 0.8;
const LOWEST = 0.6; // device pixels per CSS pixel, along each side
const IDLE_MS = 400;

/**
 * Sharpness of a moving picture. If pictures come late, they get fewer pixels, because fewer pixels are better than
 * fewer pictures. If they come early for a while, sharpness comes back; each attempt that fails doubles that while.
 * Only pictures in consecutive animation frames count: the others come late because nobody asked for them earlier.
 */
export class Quality {
  ratio: number;
  private readonly lowest: number;
  private late = 0;
  private quick = 0;
  private patience = QUICK_PICTURES;
  private raised = false;
  /** When the last animation frame drew a picture, ms; NaN if it drew none. */
  private drawn = Number.NaN;

  /** best: device pixels per CSS pixel of the sharpest picture. */
  constructor(readonly best: number) {
    this.ratio = best;
    this.lowest = Math.min(best, LOWEST);
  }

  get lowered(): boolean {
    return this.ratio < this.best;
  }

  /** An animation frame draws no moving picture. */
  skip(): void {
    this.drawn = Number.NaN;
  }

  /** An animation frame draws a picture at the time `now`, ms. Returns whether the sharpness changes. */
  draw(now: number): boolean {
    const took = now - this.drawn;
    this.drawn = now;
    if (!(took <= IDLE_MS)) return false; // the first picture, or the page was hidden
    this.late = took > LATE_MS ? this.late + 1 : Math.max(0, this.late - 2);
    this.quick = took < QUICK_MS ? this.quick + 1 : took > LATE_MS ? 0 : this.quick;
    if (this.late >= LATE_PICTURES && this.ratio > this.lowest) {
      if (this.raised) this.patience = Math.min(2 * this.patience, MOST_PATIENCE);
      return this.set(Math.max(this.lowest, this.ratio * STEP), false);
    }
    if (this.quick >= this.patience && this.lowered) return this.set(Math.min(this.best, this.ratio / STEP), true);
    return false;
  }

  private set(ratio: number, raised: boolean): true {
    this.ratio = ratio;
    this.raised = raised;
    this.late = this.quick = 0;
    return true;
  }

  /** The pixels along each side, as a share of the sharpest moving picture, if they are fewer; otherwise empty. */
  words(): string {
    return this.lowered ? `Coarser while moving: ${Math.round((100 * this.ratio) / this.best)} %` : "";
  }
}
