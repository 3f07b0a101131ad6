import type { History } from "../state/history.ts";
import { codeOf, type FloatColumn } from "../wire/ticks.ts";

type Column = Exclude<FloatColumn, "time">;
const OUTSIDE = codeOf("phase", "outside");

/** The ticks from `first` up to but not including `end`. */
export interface Ticks {
  readonly history: History;
  readonly first: number;
  readonly end: number;
}

/** Where the values go: out[i] = bias + gain * value. */
export interface Into {
  readonly gain: number;
  readonly bias: number;
  readonly out: Float32Array;
}

type Use = (slot: number, n: number, at: number) => void;

/** Calls `use` for each contiguous part of the ticks in the ring buffers: two parts at most. */
function eachPart({ history, first, end }: Ticks, use: Use): void {
  for (let at = 0; first + at < end; ) {
    const slot = history.slot(first + at);
    const n = Math.min(end - first - at, history.capacity - slot);
    use(slot, n, at);
    at += n;
  }
}

/** The values row[offset] of the column. */
export function gather(ticks: Ticks, column: Column, offset: number, { gain, bias, out }: Into): void {
  const { history } = ticks;
  const values = history.column(column);
  const width = history.width(column);
  eachPart(ticks, (slot, n, at) => {
    for (let i = 0, from = slot * width + offset; i < n; i++, from += width) out[at + i] = bias + gain * values[from]!;
  });
}

/** As `gather`, for the time, s. */
export function gatherTime(ticks: Ticks, { gain, bias, out }: Into): void {
  const { history } = ticks;
  eachPart(ticks, (slot, n, at) => {
    for (let i = 0; i < n; i++) out[at + i] = bias + gain * history.time[slot + i]!;
  });
}

/** Whether the other solver ran at any of the ticks. */
export function isCompared({ history, first, end }: Ticks): boolean {
  const other = history.column("other_force");
  for (let tick = first; tick < end; tick++) if (!Number.isNaN(other[3 * history.slot(tick)]!)) return true;
  return false;
}

/**
 * Estimates a membrane's axial force with the other solver, N: this solver's axial force plus the difference of the
 * two total forces along b. NaN while the tip is outside the membrane. With a single membrane on the needle, the
 * result is the other solver's axial force itself.
 */
export function gatherOther(ticks: Ticks, membrane: number, { gain, bias, out }: Into): void {
  const { history } = ticks;
  const m = history.membranes;
  const axial = history.column("axial_force");
  const other = history.column("other_force");
  const model = history.column("model_force");
  const b = history.column("direction");
  const phase = history.byteColumn("phase");
  eachPart(ticks, (slot, n, at) => {
    for (let i = 0; i < n; i++) {
      const row = slot + i;
      const cell = row * m + membrane;
      if (phase[cell] === OUTSIDE) {
        out[at + i] = Number.NaN;
        continue;
      }
      let along = axial[cell]!;
      for (let k = 0; k < 3; k++) along += b[3 * cell + k]! * (other[3 * row + k]! - model[3 * row + k]!);
      out[at + i] = bias + gain * along;
    }
  });
}

/**
 * The size of a force, N; negative if it pulls the needle in. `force` is what the device gives, after all limits;
 * `model_force` is what exercises judge. They are equal while no limit acts.
 */
export function gatherSize(ticks: Ticks, column: "force" | "model_force", { gain, bias, out }: Into): void {
  const { history } = ticks;
  eachPart(ticks, (slot, n, at) => {
    for (let i = 0; i < n; i++) out[at + i] = bias + gain * signedSize(history, column, slot + i);
  });
}

/** The size of a force in a row, N; negative if it pulls the needle in. */
export function signedSize(history: History, column: "force" | "model_force", row: number): number {
  const force = history.column(column);
  const axis = history.column("axis");
  const from = 3 * row;
  const x = force[from]!;
  const y = force[from + 1]!;
  const z = force[from + 2]!;
  const inwards = x * axis[from]! + y * axis[from + 1]! + z * axis[from + 2]!;
  const size = Math.sqrt(x * x + y * y + z * z);
  return inwards > 0 ? -size : size;
}

/** A membrane's share of the felt force, along the needle, N: the device scales all shares alike. NaN outside it. */
export function gatherFelt(ticks: Ticks, membrane: number, { gain, bias, out }: Into): void {
  const { history } = ticks;
  const m = history.membranes;
  const [axial, force, model] = [history.column("axial_force"), history.column("force"), history.column("model_force")];
  const phase = history.byteColumn("phase");
  const size = (values: Float32Array, row: number): number =>
    Math.sqrt(values[3 * row]! ** 2 + values[3 * row + 1]! ** 2 + values[3 * row + 2]! ** 2);
  eachPart(ticks, (slot, n, at) => {
    for (let i = 0; i < n; i++) {
      const row = slot + i;
      const cell = row * m + membrane;
      const whole = size(model, row);
      const share = phase[cell] === OUTSIDE ? Number.NaN : whole > 0 ? size(force, row) / whole : 0;
      out[at + i] = bias + gain * axial[cell]! * share;
    }
  });
}

/** The force limit while the tip is inside a membrane, N; NaN outside it. */
export function gatherPermitted(ticks: Ticks, membrane: number, into: Into): void {
  const { history } = ticks;
  gather(ticks, "ceiling", 0, into);
  const m = history.membranes;
  const phase = history.byteColumn("phase");
  eachPart(ticks, (slot, n, at) => {
    for (let i = 0; i < n; i++) if (phase[(slot + i) * m + membrane] === OUTSIDE) into.out[at + i] = Number.NaN;
  });
}

/** The lowest and the highest of some numbers, without NaN; low > high if there are none. */
export class Extent {
  low = Number.POSITIVE_INFINITY;
  high = Number.NEGATIVE_INFINITY;

  forget(): void {
    this.low = Number.POSITIVE_INFINITY;
    this.high = Number.NEGATIVE_INFINITY;
  }
  take(value: number): void {
    if (value < this.low) this.low = value;
    if (value > this.high) this.high = value;
  }
  takeNumbers(values: Float32Array, count: number): void {
    for (let i = 0; i < count; i++) this.take(values[i]!);
  }
  takeColumn(ticks: Ticks, column: Column, offset: number, gain: number): void {
    const { history } = ticks;
    const values = history.column(column);
    const width = history.width(column);
    let low = Number.POSITIVE_INFINITY;
    let high = Number.NEGATIVE_INFINITY;
    eachPart(ticks, (slot, n) => {
      for (let i = 0, from = slot * width + offset; i < n; i++, from += width) {
        const value = values[from]!;
        if (value < low) low = value;
        if (value > high) high = value;
      }
    });
    if (low > high) return;
    this.take(gain * low);
    this.take(gain * high);
  }
}

export interface Difference {
  /** Number of ticks for which both solvers have a force. */
  readonly ticks: number;
  /** N */
  readonly rms: number;
  /** N */
  readonly largest: number;
}

/**
 * Size of the difference between the two solvers' forces. Null if no tick has both forces.
 */
export function difference({ history, first, end }: Ticks): Difference | null {
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
