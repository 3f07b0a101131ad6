import type { History } from "../state/history.ts";
import { Source } from "../state/source.ts";
import { BYTE_COLUMNS, type ByteColumn, type FloatColumn, type TickBatch } from "../wire/ticks.ts";

const CHUNK = 1024; // ticks; times are f32 relative to the first of a chunk, which keeps them exact to nanoseconds

// biome-ignore format: a table
const FLOATS = [
  "position", "axis", "tip", "model_force", "force", "ceiling",
  "depth", "axial_force", "lower", "upper", "proxy", "direction",
] as const;

/** A copy of a source's present data. The live source overwrites old ticks; the copy keeps them. */
export function frozenCopy(source: Source): Source {
  const { history } = source;
  const copy = new Source(`${source.title}, frozen`, false, Math.max(1, history.length));
  copy.scene.value = source.scene.value;
  copy.laws.value = source.laws.value;
  copy.events.value = source.events.value;
  for (let tick = history.first; tick < history.end; ) {
    const n = Math.min(CHUNK, history.end - tick, history.capacity - history.slot(tick));
    copy.history.push(batchOf(history, tick, n));
    tick += n;
  }
  return copy;
}

/** n ticks as one batch; they must be contiguous in the ring buffers. */
function batchOf(history: History, first: number, n: number): TickBatch {
  const slot = history.slot(first);
  const firstTime = history.timeOf(first);
  const time = new Float32Array(n);
  for (let i = 0; i < n; i++) time[i] = history.time[slot + i]! - firstTime;
  const rows = (name: Exclude<FloatColumn, "time">): Float32Array => {
    const width = history.width(name);
    return history.column(name).subarray(slot * width, (slot + n) * width);
  };
  const byteRows = (name: ByteColumn): Uint8Array => {
    const width = history.width(name);
    return history.byteColumn(name).subarray(slot * width, (slot + n) * width);
  };
  const floats = { time } as Record<Exclude<FloatColumn, "other_force">, Float32Array>;
  for (const name of FLOATS) floats[name] = rows(name);
  const bytes = {} as Record<ByteColumn, Uint8Array>;
  for (const name of BYTE_COLUMNS) bytes[name] = byteRows(name);
  return {
    firstTick: first,
    firstTime,
    run: 0,
    lost: history.lost,
    count: n,
    membranes: history.membranes,
    floats,
    bytes,
    otherForce: rows("other_force"),
  };
}
