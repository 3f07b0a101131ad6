const EACH_MS = 1000 / 30; // time of a picture at 30 a second
const QUICK_MS = 22;
const MOST_BEHIND_MS = 300;
const LONGEST_MS = 100; // a longer picture counts as this: one stop of the page says little about its speed
const QUICK_PICTURES = 120;
const MOST_PATIENCE = 8 * QUICK_PICTURES;
const STEP = 0.8;
const LOWEST = 0.8; // device pixels per CSS pixel, along each side
const IDLE_MS = 400;
const REST_MS = 180; // after the last motion the picture is sharp

/**
 * Sharpness of a moving picture. If fewer than 30 pictures a second come on average, they get fewer pixels, because
 * fewer pixels are better than fewer pictures. If they come early for a while, sharpness comes back; each attempt that
 * fails doubles that while. A picture takes the time until the browser asks for the next one, whether there is
 * something new to draw or not.
 */
export class Quality {
  ratio: number;
  private readonly lowest: number;
  /** How far the pictures are behind 30 a second, ms. */
  private behind = 0;
  private quick = 0;
  private patience = QUICK_PICTURES;
  private raised = false;
  /** When the last picture was begun, ms; NaN if its time is known already. */
  private begun = Number.NaN;
  /** Whether the browser has painted since then. */
  private painted = false;
  /** When something moved, ms. */
  private moved = Number.NEGATIVE_INFINITY;

  /** best: device pixels per CSS pixel of the sharpest picture. */
  constructor(readonly best: number) {
    this.ratio = best;
    this.lowest = Math.min(best, LOWEST);
  }

  get lowered(): boolean {
    return this.ratio < this.best;
  }

  /** Whether a picture at the time `now`, ms, is one at rest. A trail that fades is no motion. */
  rests(now: number, moves: boolean): boolean {
    if (moves) this.moved = now;
    return now - this.moved >= REST_MS;
  }

  /**
   * The browser asks for a picture at the time `now`, ms. draws: whether a new one is drawn
   * that moves. painted: whether the
   * browser paints next. Returns whether the sharpness changes.
   */
  step(now: number, draws: boolean, painted: boolean): boolean {
    const took = this.painted ? now - this.begun : Number.NaN;
    if (this.painted) this.begun = Number.NaN;
    if (draws) this.begun = now;
    this.painted = painted && !Number.isNaN(this.begun);
    return took <= IDLE_MS && this.judge(took); // otherwise the page was hidden
  }

  private judge(took: number): boolean {
    this.behind = Math.max(0, this.behind + Math.min(took, LONGEST_MS) - EACH_MS);
    this.quick = took < QUICK_MS ? this.quick + 1 : took > EACH_MS + 1 ? 0 : this.quick;
    if (this.behind >= MOST_BEHIND_MS && this.ratio > this.lowest) {
      if (this.raised) this.patience = Math.min(2 * this.patience, MOST_PATIENCE);
      return this.set(Math.max(this.lowest, this.ratio * STEP), false);
    }
    if (this.quick >= this.patience && this.lowered) return this.set(Math.min(this.best, this.ratio / STEP), true);
    return false;
  }

  private set(ratio: number, raised: boolean): true {
    this.ratio = ratio;
    this.raised = raised;
    this.behind = this.quick = 0;
    return true;
  }

  /** The pixels along each side, as a share of the sharpest moving picture, if they are fewer; otherwise empty. */
  words(): string {
    return this.lowered ? `Coarser while moving: ${Math.round((100 * this.ratio) / this.best)} %` : "";
  }
}
