import type { App } from "../state/app.ts";
import { copiedHistory } from "../state/frozen.ts";
import { tickAt } from "../state/history.ts";
import { type Excerpt, keptWords, Source } from "../state/source.ts";
import type { MembraneEvent } from "../wire/messages.ts";

/** The words of every button that shows a pop again. */
export const SHOW_AGAIN = "Show the pop again, slowly";

/** Shown again: this long before the pop, and this long after it, s. */
const HALF = 0.05;
/** The same of the worst moment of an attempt: 3 s at a third of the speed. */
const [BEFORE_MOMENT, AFTER_MOMENT] = [0.7, 0.3];

/** The last pop of a source at or before its shown tick; null if there is none. */
export function lastPop(source: Source): MembraneEvent | null {
  const shown = source.shown();
  if (shown === null) return null;
  return source.events.value.findLast(({ what, tick }) => what === "pop" && tick <= shown) ?? null;
}

/** The ticks around an event as a source of its own; null if the source no longer holds the event's tick. */
function excerptAround(source: Source, event: MembraneEvent): Source | null {
  const of = source.excerpt?.of ?? source;
  const { first, end } = source.history;
  const scene = source.scene.value;
  if (!scene || event.tick < first || event.tick >= end) return null;
  const ticks = Math.round(HALF * scene.rate);
  // The live history overwrites its old ticks. A whole copy also keeps the holes that the needle made before.
  const history = source.live ? copiedHistory(source.history) : source.history;
  const excerpt = {
    of,
    event,
    tick: event.tick,
    first: Math.max(first, event.tick - ticks),
    last: Math.min(end - 1, event.tick + ticks),
  };
  return excerptOf(source, `${event.name}, slowly`, history, excerpt);
}

function excerptOf(source: Source, title: string, history: Source["history"], excerpt: Excerpt): Source {
  const made = new Source(title, false, history, excerpt);
  made.scene.value = source.scene.value;
  made.laws.value = source.laws.value;
  made.events.value = source.events.value;
  made.cursor.value = excerpt.first;
  return made;
}

/**
 * Shows the second of a recording around a time of its run (s), slowly; the live run comes after it. Returns whether
 * the recording has it.
 */
export function showMoment(app: App, recording: Source, time: number): boolean {
  const { history, scene } = recording;
  // A loop that was late has fewer ticks in a second than its rate says.
  const tick = tickAt(history, time);
  if (!scene.value || tick === history.end) return false;
  const excerpt = {
    of: app.live,
    event: null,
    tick,
    first: tickAt(history, time - BEFORE_MOMENT),
    last: Math.min(history.end - 1, tickAt(history, time + AFTER_MOMENT)),
  };
  app.source.value = excerptOf(recording, recording.title, history, excerpt);
  return true;
}

/** Shows an event again, slowly, in the view and all plots. Returns whether the page still has its ticks. */
export function showAgain(app: App, event: MembraneEvent): boolean {
  const made = excerptAround(app.source.value, event);
  if (made) app.source.value = made;
  else app.notify(`This pop is too old to be shown again: the page keeps ${keptWords(app.live)}.`);
  return made !== null;
}

/** Shows the last pop again, slowly, if there was one. In an excerpt it begins anew. */
export function showLastAgain(app: App): void {
  const { value: source } = app.source;
  const pop = source.excerpt ? source.excerpt.event : lastPop(source);
  if (pop) showAgain(app, pop);
  else if (!source.excerpt) app.notify("There was no pop yet.");
}

/** Goes back to the source that the excerpt is a part of. */
export function leaveExcerpt(app: App): void {
  const { excerpt } = app.source.value;
  if (excerpt) app.source.value = excerpt.of;
}
