/** How long the trail shows a place of the tip. */
export const TRAIL_SECONDS = 2.5;
const FADES_PER_SECOND = 4; // in full sharpness

/** Says when the trail needs a new picture while the needle stands still, because the trail goes on fading. */
export class Fade {
  private moved = 0;
  private drawn = -1;

  /** time: of the run, s. moves: whether the picture changes anyway. Returns whether the trail needs a new picture. */
  step(time: number, moves: boolean): boolean {
    if (moves) this.moved = time;
    const now = Math.abs(time - this.moved) < TRAIL_SECONDS ? Math.floor(time * FADES_PER_SECOND) : -1;
    const faded = now !== this.drawn;
    this.drawn = now;
    return faded;
  }
}
