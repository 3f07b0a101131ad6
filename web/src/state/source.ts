import type { LawCurve, MembraneEvent, SceneView } from "../wire/messages.ts";
import { History } from "./history.ts";
import { Signal } from "./signal.ts";

/** The part of another source that is shown again. */
export interface Excerpt {
  /** The source that is shown after it. */
  readonly of: Source;
  /** The pop in its middle; null: the worst moment of an attempt. */
  readonly event: MembraneEvent | null;
  /** The tick from which its time counts. */
  readonly tick: number;
  /** Its first and last tick. */
  readonly first: number;
  readonly last: number;
}

/** One run to show: the live one, a part of it that stands still, or a recording. Panels draw any source alike. */
export class Source {
  readonly scene = new Signal<SceneView | null>(null);
  readonly laws = new Signal<readonly LawCurve[]>([]);
  readonly events = new Signal<readonly MembraneEvent[]>([]);
  /** The ticks in which the live estimate found a puncture. */
  readonly punctures = new Signal<readonly number[]>([]);
  readonly history: History;
  /** The name of the recording that it shows; null if it shows none. */
  recording: string | null = null;
  /** The tick at which the timeline stands; null: it follows the last tick. */
  readonly cursor = new Signal<number | null>(null);
  /** The tick that somebody points at in a plot, with the pointer or with keys; null if nobody does. */
  readonly pointed = new Signal<number | null>(null);

  /** kept: the number of ticks that are kept, or a history with ticks. paused: a copy of the live run, that goes on. */
  constructor(
    readonly title: string,
    readonly live: boolean,
    kept: number | History,
    readonly excerpt: Excerpt | null = null,
    readonly paused = false,
  ) {
    this.history = typeof kept === "number" ? new History(kept) : kept;
  }

  /** The tick at which the timeline stands; null before the first. */
  present(): number | null {
    return this.inside(this.cursor.value);
  }

  /** The moment: the tick that the view, the plots and the tables show; null before the first. */
  shown(): number | null {
    return this.inside(this.pointed.value ?? this.cursor.value);
  }

  private inside(tick: number | null): number | null {
    const { first, end } = this.history;
    if (end === first) return null;
    return tick === null ? end - 1 : Math.min(Math.max(tick, first), end - 1);
  }
}

/** How much of a run its source keeps: "the last 82 seconds", at the scene's rate. */
export function keptWords({ history, scene }: Source): string {
  const rate = scene.value?.rate;
  if (!rate) return `the last ${history.capacity} ticks`;
  return `the last ${Math.floor(history.capacity / rate)} seconds`;
}
