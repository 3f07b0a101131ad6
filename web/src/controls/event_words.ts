import type { History } from "../state/history.ts";
import { dropText, fallenForce } from "../state/scale.ts";
import type { MembraneEvent } from "../wire/messages.ts";

/** The words of an event in the list, and for a pop the drop of the force. history: of the event's run. */
export function eventWords(event: MembraneEvent, history: History): { readonly word: string; readonly force: string } {
  switch (event.what) {
    case "touch":
      return { word: "contact", force: "" };
    case "pop":
      return { word: "pop", force: dropText(history, event) };
    case "out":
      return { word: "out", force: "" };
  }
}

/** A pop as a sentence for a screen reader. */
export const popSentence = (event: MembraneEvent, history: History): string =>
  `Pop through ${event.name}: the ${fallenForce(history, event.tick)} fell by ` +
  `${Math.abs(event.drop).toFixed(2)} newtons.`;

/** The events of `now` after the last of `before`; null if `now` is a different list. */
export function eventsSince(
  before: readonly MembraneEvent[],
  now: readonly MembraneEvent[],
): readonly MembraneEvent[] | null {
  const last = before.at(-1);
  if (!last) return now;
  const at = now.lastIndexOf(last);
  return at < 0 ? null : now.slice(at + 1);
}
