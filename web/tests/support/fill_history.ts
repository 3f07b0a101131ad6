import { History } from "../../src/state/history.ts";
import type { FloatColumn, TickBatch } from "../../src/wire/ticks.ts";
import { rowWidth } from "../../src/wire/ticks.ts";

const FLOATS = [
  "time", "position", "axis", "tip", "model_force", "force_scale", "force", "ceiling", "depth", "axial_force",
  "lower", "upper", "proxy", "direction", "plunger", "thumb_force",
] as const; // biome-ignore format: a table

export interface Cell {
  /** Of a column's row, one number for each place. */
  readonly [column: string]: (tick: number) => readonly number[];
}

/** A batch of ticks at 1 kHz, whose columns are made by functions of the tick; what has none is zero. */
export function batch(first: number, count: number, membranes: number, cells: Cell = {}): TickBatch {
  const floats = {} as Record<Exclude<FloatColumn, "other_force">, Float32Array>;
  const fill = (name: FloatColumn): Float32Array => {
    const width = rowWidth(name, membranes);
    const values = new Float32Array(count * width);
    for (let i = 0; i < count; i++) values.set(cells[name]?.(first + i) ?? [], i * width);
    return values;
  };
  for (const name of FLOATS) floats[name] = fill(name);
  if (!cells.force_scale) floats.force_scale.fill(1);
  for (let i = 0; i < count; i++) floats.time[i] = i / 1000;
  const bytes = {
    state: new Uint8Array(count),
    fault: new Uint8Array(count),
    limit: new Uint8Array(count),
    phase: new Uint8Array(count * membranes),
  };
  for (let i = 0; i < count; i++) {
    bytes.state.set(cells.state?.(first + i) ?? [], i);
    bytes.limit.set(cells.limit?.(first + i) ?? [], i);
    bytes.phase.set(cells.phase?.(first + i) ?? [], i * membranes);
  }
  return {
    firstTick: first,
    firstTime: first / 1000,
    run: 0,
    lost: 0,
    count,
    membranes,
    floats,
    bytes,
    otherForce: cells.other_force ? fill("other_force") : null,
  };
}

/** A history of `count` ticks from 0 on, kept in rings of `capacity`. */
export function history(count: number, membranes: number, cells: Cell = {}, capacity = count): History {
  const made = new History(capacity);
  for (let first = 0; first < count; first += 100)
    made.push(batch(first, Math.min(100, count - first), membranes, cells));
  return made;
}
