import type { Source } from "../state/source.ts";
import type { MembraneEvent } from "../wire/messages.ts";

/** For this long after a pop its ring is shown, s of the run. */
const RING_S = 0.9;
const GROWN = 7; // radii of the needle by which the ring grows
const FIRST = 2.5; // radii of the needle at the pop

/** The ring of a pop at one moment. */
export interface Ring {
  readonly event: MembraneEvent;
  /** In radii of the needle. */
  readonly radius: number;
  /** 1 at the pop, 0 at the end. */
  readonly alpha: number;
}

/**
 * The ring that belongs to the shown tick; null if no pop was shortly before it. It depends on the run's time only, so
 * a replay shows it slower. In an excerpt it lasts until the last tick. still: it neither grows nor fades.
 */
export function ringOf(source: Source, still: boolean): Ring | null {
  const shown = source.shown();
  if (shown === null) return null;
  const { history, excerpt } = source;
  const pop = source.events.value.findLast(({ what, tick }) => what === "pop" && tick <= shown);
  if (!pop || pop.tick < history.first) return null;
  const age = history.timeOf(shown) - history.timeOf(pop.tick);
  const end = excerpt?.event ? history.timeOf(excerpt.last) - history.timeOf(pop.tick) : RING_S;
  if (!(age <= end)) return null;
  const done = end > 0 ? age / end : 0;
  if (still) return { event: pop, radius: FIRST + GROWN / 2, alpha: 1 };
  return { event: pop, radius: FIRST + GROWN * (1 - (1 - done) ** 3), alpha: excerpt?.event ? 1 : 1 - done ** 2 };
}
