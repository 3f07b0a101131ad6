import { FIELDS } from "./tick_table.ts";

/** The binary frame of ticks; python/punctura/studio/wire/frames.py has the table of its bytes. */

const MAGIC = 0x32544e50; // "PNT2"
const HEAD_BYTES = 40;
const OTHER_SOLVER = 1;

type Field = (typeof FIELDS)[number];
type NumberField = Extract<Field, { words: null }>;
type WordField = Exclude<Field, { words: null }>;
export type FloatColumn = NumberField["name"] | "other_force";
export type ByteColumn = WordField["name"];

const FLOATS = FIELDS.filter((field): field is NumberField => field.words === null);
const BYTES = FIELDS.filter((field): field is WordField => field.words !== null);
export const BYTE_COLUMNS: readonly ByteColumn[] = BYTES.map((field) => field.name);

/** The words of a field, by its numbers. */
export function wordsOf<Name extends ByteColumn>(name: Name): Words<Name> {
  return BYTES.find((field) => field.name === name)!.words as unknown as Words<Name>;
}
type Words<Name> = { [F in WordField as F["name"]]: F["words"] }[Name & ByteColumn];

export class FrameError extends Error {}

/** n ticks that follow one another. Columns are row by row; times are s after `firstTime`. */
export interface TickBatch {
  readonly firstTick: number;
  readonly firstTime: number;
  readonly run: number;
  readonly lost: number;
  readonly count: number;
  readonly membranes: number;
  readonly floats: Readonly<Record<Exclude<FloatColumn, "other_force">, Float32Array>>;
  readonly bytes: Readonly<Record<ByteColumn, Uint8Array>>;
  /** Of the other solver, while solvers are compared: 3 a tick, N. */
  readonly otherForce: Float32Array | null;
}

/** Width in numbers of one tick's row. */
export function rowWidth(column: FloatColumn | ByteColumn, membranes: number): number {
  if (column === "other_force") return 3;
  const field = FIELDS.find(({ name }) => name === column)!;
  return field.perMembrane ? field.width * membranes : field.width;
}

/** Reads a frame without copying. Throws FrameError. */
export function decodeTicks(frame: ArrayBuffer, at = 0, end = frame.byteLength): TickBatch {
  if (end - at < HEAD_BYTES) throw new FrameError(`${end - at} bytes are too few for a frame`);
  const head = new DataView(frame, at, HEAD_BYTES);
  const magic = head.getUint32(0, true);
  if (magic !== MAGIC) throw new FrameError(`begins with 0x${magic.toString(16)}`);
  const count = head.getUint32(4, true);
  const membranes = head.getUint32(8, true);
  const flags = head.getUint32(12, true);
  let offset = at + HEAD_BYTES;
  const floats = {} as Record<FloatColumn, Float32Array>;
  const bytes = {} as Record<ByteColumn, Uint8Array>;

  const takeFloats = (name: FloatColumn): void => {
    const length = count * rowWidth(name, membranes);
    if (offset + 4 * length > end) throw new FrameError(`ends within ${name}`);
    floats[name] = new Float32Array(frame, offset, length);
    offset += 4 * length;
  };
  for (const { name } of FLOATS) takeFloats(name);
  if (flags & OTHER_SOLVER) takeFloats("other_force");
  for (const { name } of BYTES) {
    const length = count * rowWidth(name, membranes);
    if (offset + length > end) throw new FrameError(`ends within ${name}`);
    bytes[name] = new Uint8Array(frame, offset, length);
    offset += length;
  }
  if (offset !== end) throw new FrameError(`${end - offset} bytes follow its end`);
  return {
    firstTick: Number(head.getBigUint64(16, true)),
    firstTime: head.getFloat64(24, true),
    run: head.getUint32(32, true),
    lost: head.getUint32(36, true),
    count,
    membranes,
    floats,
    bytes,
    otherForce: flags & OTHER_SOLVER ? floats.other_force : null,
  };
}
