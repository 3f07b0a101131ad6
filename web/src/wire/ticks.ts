/** The binary frame of ticks; python/punctura/studio/wire/frames.py has the table of its bytes. */

const MAGIC = 0x31544e50; // "PNT1"
const HEAD_BYTES = 40;
const OTHER_SOLVER = 1;

/** Width of a row, and whether each membrane has one. */
const FLOATS = [
  ["time", 1, false],
  ["position", 3, false],
  ["axis", 3, false],
  ["tip", 3, false],
  ["model_force", 3, false],
  ["force", 3, false],
  ["ceiling", 1, false],
  ["depth", 1, true],
  ["axial_force", 1, true],
  ["lower", 1, true],
  ["upper", 1, true],
  ["proxy", 3, true],
  ["direction", 3, true],
] as const;
const BYTES = [
  ["state", false],
  ["fault", false],
  ["limit", false],
  ["phase", true],
] as const;

export type FloatColumn = (typeof FLOATS)[number][0] | "other_force";
export type ByteColumn = (typeof BYTES)[number][0];

export const BYTE_COLUMNS: readonly ByteColumn[] = BYTES.map(([name]) => name);

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
  for (const [name, width, each] of FLOATS) if (name === column) return each ? width * membranes : width;
  return column === "phase" ? membranes : 1;
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
  for (const [name] of FLOATS) takeFloats(name);
  if (flags & OTHER_SOLVER) takeFloats("other_force");
  for (const [name] of BYTES) {
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
