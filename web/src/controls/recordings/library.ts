import { errorText } from "../../format.ts";
import type { App } from "../../state/app.ts";
import { Signal } from "../../state/signal.ts";
import type { Source } from "../../state/source.ts";
import { recordingPath } from "../../wire/api.ts";
import type { RecordingEntry } from "../../wire/messages.ts";
import { type Fetched, fetchSource, type Progress } from "./fetch_source.ts";

const FINISHING = 10; // s that the server gets to finalize a file
const KEPT = 2; // recordings are large: only the shown one and the compared one stay in memory

/** The list of recordings, and the recordings that this page has loaded. */
export class Library {
  readonly entries = new Signal<readonly RecordingEntry[] | null>(null);
  /** The reason why there is no list; empty if there is one. */
  readonly trouble = new Signal("");
  private later: ReturnType<typeof setTimeout> | undefined;
  private readonly fetched = new Map<string, Fetched>();

  constructor(readonly app: App) {
    app.connection.watch((now) => now.state === "open" && void this.refresh());
    let recording = false;
    app.recording.watch((now) => {
      if (recording && !now) void this.refresh();
      recording = now !== null;
    });
    app.exercise.watch((now) => now?.result && void this.refresh());
  }

  async refresh(again = FINISHING): Promise<void> {
    clearTimeout(this.later);
    try {
      this.entries.value = await this.app.api.json<RecordingEntry[]>("/api/recordings");
      this.trouble.value = "";
      // The server finalizes a file in the background, shortly after its end.
      const open = this.entries.value.some(({ finished, started }) => !finished && recent(started));
      if (open && again > 0) this.later = setTimeout(() => void this.refresh(again - 1), 1000);
    } catch (error) {
      this.trouble.value = errorText(error);
    }
  }

  /** Throws what fetchSource throws. */
  async open(entry: RecordingEntry, progress: (now: Progress) => void, signal: AbortSignal): Promise<Source> {
    const known = this.fetched.get(entry.name);
    const fetched = known ?? (await fetchSource(this.app.api, entry, progress, signal));
    this.fetched.delete(entry.name);
    this.fetched.set(entry.name, fetched);
    for (const [name, { source }] of this.fetched) {
      if (this.fetched.size <= KEPT) break;
      if (source !== this.app.source.value && source !== this.app.overlay.value) this.fetched.delete(name);
    }
    if (!known && fetched.left > 0)
      this.app.notify(`${entry.name} is too long for this page: the last ${fetched.left} ticks are left out.`);
    return fetched.source;
  }

  async remove(entry: RecordingEntry): Promise<void> {
    await this.app.api.remove(recordingPath(entry.name));
    const { app } = this;
    if (app.source.value.recording === entry.name) app.source.value = app.live;
    if (app.overlay.value?.recording === entry.name) app.overlay.value = null;
    this.fetched.delete(entry.name);
    await this.refresh();
  }
}

const recent = (iso: string): boolean => Date.now() - new Date(iso).getTime() < 3_600_000;
