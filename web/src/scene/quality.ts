const LATE_MS = 40; // a picture that takes longer than this is late: fewer than 25 a second
const QUICK_MS = 22;
const LATE_PICTURES = 12;
const QUICK_PICTURES = 120;
const STEP = 0.8;
const LOWEST = 0.6; // device pixels per CSS pixel, along each side
const IDLE_MS = 400;

/**
 * Sharpness of a moving picture. If pictures come late, they get fewer pixels, because fewer pixels are better than
 * fewer pictures. If they come early for a while, sharpness comes back; each attempt that fails doubles that while.
 */
export class Quality {
  ratio: number;
  private readonly lowest: number;
  private late = 0;
  private quick = 0;
  private patience = QUICK_PICTURES;
  private raised = false;

  /** best: device pixels per CSS pixel of the sharpest picture. */
  constructor(readonly best: number) {
    this.ratio = best;
    this.lowest = Math.min(best, LOWEST);
  }

  get lowered(): boolean {
    return this.ratio < this.best;
  }

  /** took: time since the last picture, ms. Returns whether the sharpness changes. */
  watch(took: number): boolean {
    if (took > IDLE_MS) return false; // nothing moved
    this.late = took > LATE_MS ? this.late + 1 : Math.max(0, this.late - 2);
    this.quick = took < QUICK_MS ? this.quick + 1 : took > LATE_MS ? 0 : this.quick;
    if (this.late >= LATE_PICTURES && this.ratio > this.lowest) {
      if (this.raised) this.patience *= 2;
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

  /** A sentence if the picture is coarser than it could be; otherwise empty. */
  words(): string {
    return this.lowered ? `Coarser while moving: ${Math.round((100 * this.ratio) / this.best)} %` : "";
  }
}
