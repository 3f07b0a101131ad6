import { BYTE_COLUMNS, type ByteColumn, FLOAT_COLUMNS, type FloatColumn, type TickBatch } from "../wire/ticks.ts";
import { History } from "./history.ts";
import { Source } from "./source.ts";

const CHUNK = 1024; // ticks; times are f32 relative to the first of a chunk, which keeps them exact to nanoseconds

const isCopied = (name: FloatColumn): name is Exclude<FloatColumn, "time" | "other_force"> =>
  name !== "time" && name !== "other_force";
const FLOATS = FLOAT_COLUMNS.filter(isCopied);

/** A copy of the live source's present ticks, at the last of them. The live source overwrites old ticks. */
export function frozenCopy(source: Source): Source {
  const copy = new Source("Paused; the run goes on", false, copiedHistory(source.history), null, true);
  copy.scene.value = source.scene.value;
  copy.laws.value = source.laws.value;
  copy.events.value = source.events.value;
  copy.punctures.value = source.punctures.value;
  copy.cursor.value = source.present();
  return copy;
}

/** A copy of all ticks that a history holds now. */
export function copiedHistory(history: History): History {
  const copy = new History(Math.max(1, history.length));
  for (let tick = history.first; tick < history.end; ) {
    const n = Math.min(CHUNK, history.end - tick, history.capacity - history.slot(tick));
    copy.push(batchOf(history, tick, n));
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
