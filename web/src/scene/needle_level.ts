const JUMP_S = 0.5;

/**
 * A level from 0 to 1 that moves towards its goal in the run's time: a replay that stands still or jumps shows the
 * level of its moment.
 */
export class Level {
  value = 0;
  private time = Number.NaN;

  /**
   * Moves on to `time` (s). rate: share of the way left, or of the whole way if `even`, that it goes in a second.
   * Returns whether the level changed.
   */
  step(goal: number, time: number, rate: number, even = false): boolean {
    const passed = time - this.time;
    this.time = time;
    const before = this.value;
    if (!(passed >= 0 && passed <= JUMP_S)) this.value = goal;
    else if (even) this.value += Math.sign(goal - before) * Math.min(Math.abs(goal - before), rate * passed);
    else this.value += (goal - before) * (1 - Math.exp(-rate * passed));
    if (Math.abs(goal - this.value) < 0.004) this.value = goal;
    return this.value !== before;
  }
}
