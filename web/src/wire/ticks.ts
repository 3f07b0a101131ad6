import { FIELDS } from "./tick_table.ts";

/** Reads the binary frame of ticks; python/punctura/studio/wire/frames.py documents its bytes. */

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
export const FLOAT_COLUMNS: readonly FloatColumn[] = FLOATS.map((field) => field.name);
export const BYTE_COLUMNS: readonly ByteColumn[] = BYTES.map((field) => field.name);

/** The words of a field, indexed by their numbers. */
export function wordsOf<Name extends ByteColumn>(name: Name): Words<Name> {
  return BYTES.find((field) => field.name === name)!.words as unknown as Words<Name>;
}
/** The number of a word of a field. */
export const codeOf = <Name extends ByteColumn>(name: Name, word: Words<Name>[number]): number =>
  (wordsOf(name) as readonly string[]).indexOf(word);

export type Phase = Words<"phase">[number];

type Words<Name> = { [F in WordField as F["name"]]: F["words"] }[Name & ByteColumn];

export class FrameError extends Error {}

/** n consecutive ticks. Columns hold one row per tick; times are s after `firstTime`. */
export interface TickBatch {
  readonly firstTick: number;
  readonly firstTime: number;
  readonly run: number;
  readonly lost: number;
  readonly count: number;
  readonly membranes: number;
  readonly floats: Readonly<Record<Exclude<FloatColumn, "other_force">, Float32Array>>;
  readonly bytes: Readonly<Record<ByteColumn, Uint8Array>>;
  /** The other solver's force while Compare is on: 3 numbers per tick, N. */
  readonly otherForce: Float32Array | null;
}

/** How many numbers one tick has in a column. */
export function rowWidth(column: FloatColumn | ByteColumn, membranes: number): number {
  if (column === "other_force") return 3;
  const field = FIELDS.find(({ name }) => name === column)!;
  return field.perMembrane ? field.width * membranes : field.width;
}

/** Reads a frame without copying. Throws FrameError. */
export function decodeTicks(frame: ArrayBuffer, at = 0, end = frame.byteLength): TickBatch {
  if (end - at < HEAD_BYTES) throw new FrameError(`a tick frame is too short: ${end - at} bytes`);
  const head = new DataView(frame, at, HEAD_BYTES);
  const magic = head.getUint32(0, true);
  if (magic !== MAGIC) throw new FrameError(`a tick frame has the wrong magic number 0x${magic.toString(16)}`);
  const count = head.getUint32(4, true);
  const membranes = head.getUint32(8, true);
  const flags = head.getUint32(12, true);
  let offset = at + HEAD_BYTES;
  const floats = {} as Record<FloatColumn, Float32Array>;
  const bytes = {} as Record<ByteColumn, Uint8Array>;

  const takeFloats = (name: FloatColumn): void => {
    const length = count * rowWidth(name, membranes);
    if (offset + 4 * length > end) throw new FrameError(`a tick frame ends within ${name}`);
    floats[name] = new Float32Array(frame, offset, length);
    offset += 4 * length;
  };
  for (const { name } of FLOATS) takeFloats(name);
  if (flags & OTHER_SOLVER) takeFloats("other_force");
  for (const { name } of BYTES) {
    const length = count * rowWidth(name, membranes);
    if (offset + length > end) throw new FrameError(`a tick frame ends within ${name}`);
    bytes[name] = new Uint8Array(frame, offset, length);
    offset += length;
  }
  if (offset !== end) throw new FrameError(`${end - offset} bytes follow a tick frame`);
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
