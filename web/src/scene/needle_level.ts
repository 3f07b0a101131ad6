const JUMP_S = 0.5;

/**
 * A level from 0 to 1 that moves towards its goal in the run's time. After a jump it is at its goal: who knows the
 * ticks before takes these steps first.
 */
export class Level {
  value = 0;
  private time = Number.NaN;

  /** Whether a step to `time` (s) is a jump. */
  jumps(time: number): boolean {
    const passed = time - this.time;
    return !(passed >= 0 && passed <= JUMP_S);
  }

  /**
   * Moves on to `time` (s). rate: share of the way left, or of the whole way if `even`, that it goes in a second.
   * Returns whether the level changed.
   */
  step(goal: number, time: number, rate: number, even = false): boolean {
    const jumps = this.jumps(time);
    const passed = time - this.time;
    this.time = time;
    const before = this.value;
    if (jumps) this.value = goal;
    else if (even) this.value += Math.sign(goal - before) * Math.min(Math.abs(goal - before), rate * passed);
    else this.value += (goal - before) * (1 - Math.exp(-rate * passed));
    if (Math.abs(goal - this.value) < 0.004) this.value = goal;
    return this.value !== before;
  }
}
