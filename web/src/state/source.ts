import type { LawCurve, MembraneEvent, SceneView } from "../wire/messages.ts";
import { History } from "./history.ts";
import { Signal } from "./signal.ts";

/** One run to show: the live one or a recording. Panels draw any source alike. */
export class Source {
  readonly scene = new Signal<SceneView | null>(null);
  readonly laws = new Signal<readonly LawCurve[]>([]);
  readonly events = new Signal<readonly MembraneEvent[]>([]);
  readonly history: History;
  /** The tick that is shown; null for the last one. */
  readonly cursor = new Signal<number | null>(null);

  /** capacity: ticks that are kept. */
  constructor(
    readonly title: string,
    readonly live: boolean,
    capacity: number,
  ) {
    this.history = new History(capacity);
  }

  /** The tick to draw; null before the first. */
  shown(): number | null {
    const { first, end } = this.history;
    if (end === first) return null;
    const at = this.cursor.value;
    return at === null ? end - 1 : Math.min(Math.max(at, first), end - 1);
  }
}
