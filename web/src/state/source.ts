import type { LawCurve, MembraneEvent, SceneView } from "../wire/messages.ts";
import { History } from "./history.ts";
import { Signal } from "./signal.ts";

/** The part of another source that is shown again. */
export interface Excerpt {
  readonly of: Source;
  /** The event in its middle. */
  readonly event: MembraneEvent;
  /** Its first and last tick. */
  readonly first: number;
  readonly last: number;
}

/** One run to show: the live one or a recording. Panels draw any source alike. */
export class Source {
  readonly scene = new Signal<SceneView | null>(null);
  readonly laws = new Signal<readonly LawCurve[]>([]);
  readonly events = new Signal<readonly MembraneEvent[]>([]);
  readonly history: History;
  /** The tick that is shown; null for the last one. */
  readonly cursor = new Signal<number | null>(null);

  /** kept: the number of ticks that are kept, or a history with ticks. */
  constructor(
    readonly title: string,
    readonly live: boolean,
    kept: number | History,
    readonly excerpt: Excerpt | null = null,
  ) {
    this.history = typeof kept === "number" ? new History(kept) : kept;
  }

  /** The tick to draw; null before the first. */
  shown(): number | null {
    const { first, end } = this.history;
    if (end === first) return null;
    const at = this.cursor.value;
    return at === null ? end - 1 : Math.min(Math.max(at, first), end - 1);
  }
}
