import { FIELDS } from "../../src/wire/tick_table.ts";
import type { ByteColumn, FloatColumn } from "../../src/wire/ticks.ts";
import { rowWidth } from "../../src/wire/ticks.ts";

const FLOATS: readonly FloatColumn[] = FIELDS.flatMap((field) => (field.words === null ? [field.name] : []));
const BYTES: readonly ByteColumn[] = FIELDS.flatMap((field) => (field.words === null ? [] : [field.name]));

/** The number that `makeFrame` writes: another one for each column, tick and place in the row. */
export const expected = (column: FloatColumn, row: number, place: number): number =>
  column === "time"
    ? Math.fround(row / 1600)
    : (column === "other_force" ? 13 : FLOATS.indexOf(column)) * 1000 + row * 10 + place;
export const expectedByte = (column: ByteColumn, row: number, place: number): number =>
  (BYTES.indexOf(column) * 50 + row * 5 + place) % 256;

export interface FrameShape {
  first?: number;
  count: number;
  membranes: number;
  run?: number;
  lost?: number;
  other?: boolean;
  time?: number;
}

/** A frame of ticks, written byte by byte from the table in python/punctura/studio/wire/frames.py. */
export function makeFrame(shape: FrameShape): ArrayBuffer {
  const { first = 0, count, membranes, run = 0, lost = 0, other = false, time = first / 1600 } = shape;
  const floats: FloatColumn[] = other ? [...FLOATS, "other_force"] : [...FLOATS];
  const size =
    40 +
    floats.reduce((sum, name) => sum + 4 * count * rowWidth(name, membranes), 0) +
    BYTES.reduce((sum, name) => sum + count * rowWidth(name, membranes), 0);
  const view = new DataView(new ArrayBuffer(size));
  view.setUint32(0, 0x32544e50, true);
  view.setUint32(4, count, true);
  view.setUint32(8, membranes, true);
  view.setUint32(12, other ? 1 : 0, true);
  view.setBigUint64(16, BigInt(first), true);
  view.setFloat64(24, time, true);
  view.setUint32(32, run, true);
  view.setUint32(36, lost, true);
  let at = 40;
  for (const name of floats) {
    for (let row = 0; row < count; row++) {
      for (let place = 0; place < rowWidth(name, membranes); place++, at += 4) {
        view.setFloat32(at, expected(name, name === "time" ? row : first + row, place), true);
      }
    }
  }
  for (const name of BYTES) {
    for (let row = 0; row < count; row++) {
      for (let place = 0; place < rowWidth(name, membranes); place++, at += 1) {
        view.setUint8(at, expectedByte(name, first + row, place));
      }
    }
  }
  return view.buffer as ArrayBuffer;
}
