import { type Phase, wordsOf } from "../wire/ticks.ts";

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
