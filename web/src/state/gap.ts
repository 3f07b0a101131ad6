import { BYTE_COLUMNS, FLOAT_COLUMNS, rowWidth, type TickBatch } from "../wire/ticks.ts";

/** Ticks that are missing before `next`: times but no values, so that the gap is visible, and the states of `next`. */
export function gapBefore(next: TickBatch, from: number, period: number): TickBatch {
  const count = next.firstTick - from;
  const floats = Object.fromEntries(
    FLOAT_COLUMNS.map((name) => [name, new Float32Array(count * rowWidth(name, next.membranes)).fill(Number.NaN)]),
  ) as TickBatch["floats"];
  for (let i = 0; i < count; i++) floats.time[i] = i * period;
  const bytes = Object.fromEntries(
    BYTE_COLUMNS.map((name) => {
      const width = rowWidth(name, next.membranes);
      const rows = new Uint8Array(count * width);
      for (let i = 0; i < count; i++) rows.set(next.bytes[name].subarray(0, width), i * width);
      return [name, rows];
    }),
  ) as TickBatch["bytes"];
  const { run, lost, membranes } = next;
  const firstTime = next.firstTime - count * period;
  return { firstTick: from, firstTime, run, lost, count, membranes, floats, bytes, otherForce: null };
}
