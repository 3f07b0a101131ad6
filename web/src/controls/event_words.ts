import type { MembraneEvent } from "../wire/messages.ts";

/** What an event is called in a list: a word, and for a pop what the force lost. */
export function eventWords(event: MembraneEvent): { readonly word: string; readonly force: string } {
  switch (event.what) {
    case "touch":
      return { word: "touches", force: "" };
    case "pop":
      return { word: "pop", force: `−${Math.abs(event.drop).toFixed(2)} N` };
    case "out":
      return { word: "out", force: "" };
  }
}

/** A pop as a sentence to be read aloud. */
export const popSentence = (event: MembraneEvent): string =>
  `Pop through ${event.name}: the force fell by ${Math.abs(event.drop).toFixed(2)} newton.`;

/** Those of `now` that came after the last of `before`; null where `now` is another list altogether. */
export function eventsSince(
  before: readonly MembraneEvent[],
  now: readonly MembraneEvent[],
): readonly MembraneEvent[] | null {
  const last = before.at(-1);
  if (!last) return now;
  const at = now.lastIndexOf(last);
  return at < 0 ? null : now.slice(at + 1);
}
