import type { ByteColumn, FloatColumn, TickBatch } from "../wire/ticks.ts";
import { BYTE_COLUMNS, FLOAT_COLUMNS, rowWidth } from "../wire/ticks.ts";

const isKept = (name: FloatColumn): name is Exclude<FloatColumn, "time"> => name !== "time";
const KEPT = [...FLOAT_COLUMNS.filter(isKept), "other_force" as const];

/**
 * The most recent ticks, at full rate: ring buffers of columns, addressed by tick number.
 * Tick i is there while first <= i < end; its row of a column begins at slot(i) * width.
 */
export class History {
  first = 0;
  end = 0;
  /** Increases when ticks of another run replace these. */
  generation = 0;
  membranes = 0;
  lost = 0;
  time = new Float64Array(0);
  private floats = new Map<FloatColumn, Float32Array>();
  private bytes = new Map<ByteColumn, Uint8Array>();

  /** capacity: ticks. */
  constructor(readonly capacity: number) {}

  get length(): number {
    return this.end - this.first;
  }

  slot(tick: number): number {
    return tick % this.capacity;
  }

  /** Rows of `column`, `width` numbers each; valid until the next clear. */
  column(name: Exclude<FloatColumn, "time">): Float32Array {
    return this.floats.get(name) ?? new Float32Array(0);
  }
  byteColumn(name: ByteColumn): Uint8Array {
    return this.bytes.get(name) ?? new Uint8Array(0);
  }
  width(name: FloatColumn | ByteColumn): number {
    return rowWidth(name, this.membranes);
  }

  /** The numbers of one tick, a view: for drawing the present. */
  row(name: Exclude<FloatColumn, "time">, tick: number): Float32Array {
    const width = this.width(name);
    const start = this.slot(tick) * width;
    return this.column(name).subarray(start, start + width);
  }
  byteRow(name: ByteColumn, tick: number): Uint8Array {
    const width = this.width(name);
    const start = this.slot(tick) * width;
    return this.byteColumn(name).subarray(start, start + width);
  }
  timeOf(tick: number): number {
    return this.time[this.slot(tick)] ?? Number.NaN;
  }

  clear(membranes: number, first = 0): void {
    this.first = first;
    this.end = first;
    this.lost = 0;
    this.generation += 1;
    if (membranes === this.membranes && this.time.length) return;
    this.membranes = membranes;
    this.time = new Float64Array(this.capacity);
    this.floats = new Map(KEPT.map((name) => [name, new Float32Array(this.capacity * rowWidth(name, membranes))]));
    this.bytes = new Map(BYTE_COLUMNS.map((name) => [name, new Uint8Array(this.capacity * rowWidth(name, membranes))]));
  }

  push(batch: TickBatch): void {
    if (batch.membranes !== this.membranes || this.time.length === 0) this.clear(batch.membranes, batch.firstTick);
    if (batch.firstTick !== this.end) {
      // The page was too slow: the history starts again.
      this.first = batch.firstTick;
      this.end = batch.firstTick;
    }
    this.lost = batch.lost;
    for (let done = 0; done < batch.count; ) {
      const slot = this.slot(batch.firstTick + done);
      const n = Math.min(batch.count - done, this.capacity - slot);
      this.copy(batch, done, slot, n);
      done += n;
    }
    this.end = batch.firstTick + batch.count;
    this.first = Math.max(this.first, this.end - this.capacity);
  }

  private copy(batch: TickBatch, from: number, slot: number, n: number): void {
    for (let i = 0; i < n; i++) this.time[slot + i] = batch.firstTime + batch.floats.time[from + i]!;
    for (const name of KEPT) {
      const to = this.floats.get(name)!;
      const width = this.width(name);
      const source = name === "other_force" ? batch.otherForce : batch.floats[name];
      if (source) to.set(source.subarray(from * width, (from + n) * width), slot * width);
      else to.fill(Number.NaN, slot * width, (slot + n) * width);
    }
    for (const name of BYTE_COLUMNS) {
      const width = this.width(name);
      this.bytes.get(name)!.set(batch.bytes[name].subarray(from * width, (from + n) * width), slot * width);
    }
  }
}

/** The first tick at or after `time` (s); `end` if there is none. */
export function tickAt(history: History, time: number): number {
  let low = history.first;
  let high = history.end;
  while (low < high) {
    const middle = Math.floor((low + high) / 2);
    if (history.timeOf(middle) < time) low = middle + 1;
    else high = middle;
  }
  return low;
}
