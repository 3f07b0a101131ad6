import type { Connection } from "../engine/engine.ts";
import type { History } from "../state/history.ts";
import { dropText, fallenForce } from "../state/scale.ts";
import type { MembraneEvent } from "../wire/messages.ts";
import { type Phase, wordsOf } from "../wire/ticks.ts";

/** The displayed texts of the servo states, by their numbers. The mark tells them apart without colour. */
export const STATES: readonly {
  readonly name: string;
  readonly mark: string;
  readonly words: string;
  readonly why: string;
}[] = [
  { name: "disarmed", mark: "❚❚", words: "Force off", why: "The model runs; the device gives no force." },
  { name: "waiting", mark: "◌", words: "Waiting", why: "Force starts once the tip is outside all tissue." },
  { name: "active", mark: "●", words: "Force on", why: "The device gives the force of the model." },
  { name: "faulted", mark: "▲", words: "Fault", why: "The force stays off until you turn it on." },
];

/** Shown instead of "Force on" while a limit cuts the force. */
export const CUT = {
  name: "cut",
  mark: "◐",
  why: "The device gives less than the model's force. Limits protect the hand and the motors: see docs/safety.md.",
} as const;

/** The state of the connection in a few words. leftMs: time until the next attempt. studio: see Engine. */
export function connectionWords(now: Connection, silent: boolean, leftMs: number, studio = true): string {
  switch (now.state) {
    case "open":
      if (!studio) return silent ? "No ticks" : "Runs in this page";
      return silent ? "Connected, but no ticks" : "Connected";
    case "connecting":
      if (!studio) return "Loading the core";
      return now.attempt > 1 ? `Connecting, attempt ${now.attempt}` : "Connecting";
    case "lost":
      return `No connection; retry in ${Math.max(0, Math.ceil(leftMs / 1000))} s`;
    case "refused":
      return studio ? `Refused: ${now.reason}` : `Cannot run: ${now.reason}`;
  }
}

/** The displayed kinds of a membrane's phase. */
type PhaseKind = "outside" | "sticking" | "in" | "out" | "through" | "barred";

export interface PhaseWords {
  readonly kind: PhaseKind;
  /** Tells the phases apart without colour. */
  readonly symbol: string;
  readonly word: string;
  /** The needle's motion while it is through; else "". */
  readonly detail: string;
}

const PHASES = wordsOf("phase");
const WORDS: Readonly<Record<Phase, PhaseWords>> = {
  outside: { kind: "outside", symbol: "○", word: "outside", detail: "" },
  sticking: { kind: "sticking", symbol: "■", word: "sticking", detail: "" },
  sliding_in: { kind: "in", symbol: "▼", word: "sliding in", detail: "" },
  sliding_out: { kind: "out", symbol: "▲", word: "sliding out", detail: "" },
  barred: { kind: "barred", symbol: "✕", word: "barred", detail: "" },
};

const DETAILS: Partial<Record<Phase, string>> = {
  sticking: "at rest",
  sliding_in: "going in",
  sliding_out: "coming out",
};

/** The words for a phase's number. A tip inside the membrane and at least `through` deep (m) has passed through it. */
export function phaseWords(phase: number, depth: number, through: number): PhaseWords {
  const name = PHASES[phase] ?? "outside";
  const words = WORDS[name];
  if (name === "outside" || name === "barred" || !(depth >= through)) return words;
  return { kind: "through", symbol: "◆", word: "through", detail: DETAILS[name] ?? "" };
}

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
