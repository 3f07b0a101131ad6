import { Source } from "../../state/source.ts";
import { type Api, recordingPath } from "../../wire/api.ts";
import { FrameSplitter } from "../../wire/length_prefixed.ts";
import type { RecordingEntry, RecordingOverview } from "../../wire/messages.ts";
import { BYTE_COLUMNS, decodeTicks, FLOAT_COLUMNS, rowWidth, type TickBatch } from "../../wire/ticks.ts";

/** Limit for the page's memory: 11 minutes at 1600 Hz. The rest stays in the file only. */
const MOST_TICKS = 1 << 20;

export interface Progress {
  readonly bytes: number;
  readonly total: number;
}
export interface Fetched {
  readonly source: Source;
  /** Number of ticks left out at the end. */
  readonly left: number;
}

/** Loads a recording as a source. Throws ApiError, FrameError, or the signal's reason. */
export async function fetchSource(
  api: Api,
  entry: RecordingEntry,
  progress: (now: Progress) => void,
  signal?: AbortSignal,
): Promise<Fetched> {
  const init = signal ? { signal } : {};
  const path = recordingPath(entry.name);
  const overview = (await (await api.get(path, init)).json()) as RecordingOverview;
  const { scene, events, first_tick: first } = overview;
  const span = overview.ticks + entry.lost;
  const source = new Source(entry.title || entry.name, false, Math.max(Math.min(span, MOST_TICKS), 1));
  source.recording = entry.name;
  source.scene.value = scene;
  source.laws.value = scene.laws;
  source.history.clear(scene.membranes.length, first);

  const response = await api.get(`${path}/ticks`, init);
  const length = Number(response.headers.get("Content-Length"));
  const total = length > 0 ? length : overview.ticks * tickBytes(scene.membranes.length);
  const splitter = new FrameSplitter();
  const reader = response.body?.getReader();
  for (let bytes = 0; reader; ) {
    const { done, value } = await reader.read();
    if (done) {
      splitter.end();
      break;
    }
    bytes += value.byteLength;
    progress({ bytes, total: Math.max(total, bytes) });
    for (const frame of splitter.push(value)) take(source, decodeTicks(frame), 1 / scene.rate);
    if (source.history.length >= MOST_TICKS) {
      await reader.cancel();
      break;
    }
  }
  const { end } = source.history;
  source.events.value = events.filter(({ tick }) => tick < end);
  return { source, left: Math.max(first + span - end, 0) };
}

function take(source: Source, batch: TickBatch, period: number): void {
  const { history } = source;
  const room = MOST_TICKS - history.length;
  if (batch.firstTick > history.end && batch.firstTick - history.end < room)
    history.push(gapBefore(batch, history.end, period));
  if (history.length + batch.count <= MOST_TICKS) history.push(batch);
}

/** Bytes of one tick in a frame. */
function tickBytes(membranes: number): number {
  const numbers = FLOAT_COLUMNS.reduce((sum, name) => sum + rowWidth(name, membranes), 0);
  return 4 * numbers + BYTE_COLUMNS.reduce((sum, name) => sum + rowWidth(name, membranes), 0);
}

/** The lost ticks of a recording before `next`: times but no values, so that the gap is visible. */
function gapBefore(next: TickBatch, from: number, period: number): TickBatch {
  const count = next.firstTick - from;
  const floats = Object.fromEntries(
    FLOAT_COLUMNS.map((name) => [name, new Float32Array(count * rowWidth(name, next.membranes)).fill(Number.NaN)]),
  ) as TickBatch["floats"];
  for (let i = 0; i < count; i++) floats.time[i] = i * period;
  const bytes = Object.fromEntries(
    BYTE_COLUMNS.map((name) => [name, new Uint8Array(count * rowWidth(name, next.membranes))]),
  ) as TickBatch["bytes"];
  const { run, lost, membranes } = next;
  const firstTime = next.firstTime - count * period;
  return { firstTick: from, firstTime, run, lost, count, membranes, floats, bytes, otherForce: null };
}
