import type { History } from "../state/history.ts";

export interface Difference {
  /** Number of ticks for which both solvers have a force. */
  readonly ticks: number;
  /** N */
  readonly rms: number;
  /** N */
  readonly largest: number;
}

/**
 * Size of the difference between the two solvers' forces, for the ticks from `first` up to but not including `end`.
 * Null if no tick has both forces.
 */
export function difference(history: History, first: number, end: number): Difference | null {
  const model = history.column("model_force");
  const other = history.column("other_force");
  let count = 0;
  let sum = 0;
  let most = 0;
  for (let tick = first; tick < end; tick++) {
    const at = 3 * history.slot(tick);
    const x = other[at]! - model[at]!;
    const y = other[at + 1]! - model[at + 1]!;
    const z = other[at + 2]! - model[at + 2]!;
    const square = x * x + y * y + z * z;
    if (Number.isNaN(square)) continue;
    count++;
    sum += square;
    if (square > most) most = square;
  }
  return count ? { ticks: count, rms: Math.sqrt(sum / count), largest: Math.sqrt(most) } : null;
}
