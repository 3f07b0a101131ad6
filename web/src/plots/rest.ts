import type { History } from "../state/history.ts";

/** Smaller changes cannot be seen in a plot: m and N. */
const STEPS = {
  depth: 3e-5,
  axial_force: 3e-3,
  model_force: 3e-3,
  force: 3e-3,
  ceiling: 3e-3,
  thumb_force: 3e-3,
} as const;
const COLUMNS = Object.keys(STEPS) as (keyof typeof STEPS)[];

/** Finds whether a live run stands still. */
export class Rest {
  private looked = 0; // the next tick to look at
  private moved = 0; // the last tick that differed
  private generation = -1;
  private state = -1;
  /** The values at the last difference, so that a slow drift is seen. */
  private readonly last = COLUMNS.map(() => new Float32Array(0));

  /** Whether nothing has changed since the tick `from`. It looks at each tick once. */
  since(history: History, from: number): boolean {
    if (history.generation !== this.generation || this.looked < history.first) {
      this.generation = history.generation;
      this.looked = history.first;
      this.state = -1;
    }
    for (; this.looked < history.end; this.looked++) if (this.differs(history, this.looked)) this.moved = this.looked;
    return this.moved < from;
  }

  private differs(history: History, tick: number): boolean {
    const state = history.byteColumn("state")[history.slot(tick)]!;
    if (state === this.state && COLUMNS.every((name, k) => this.same(history, name, k, tick))) return false;
    this.state = state;
    COLUMNS.forEach((name, k) => {
      this.last[k] = history.row(name, tick).slice();
    });
    return true;
  }

  private same(history: History, name: keyof typeof STEPS, k: number, tick: number): boolean {
    const values = history.column(name);
    const before = this.last[k]!;
    const from = history.slot(tick) * before.length;
    for (let i = 0; i < before.length; i++) {
      const [now, then] = [values[from + i]!, before[i]!];
      if (Math.abs(now - then) > STEPS[name] || Number.isNaN(now) !== Number.isNaN(then)) return false;
    }
    return true;
  }
}
