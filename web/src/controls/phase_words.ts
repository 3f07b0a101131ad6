/** How a membrane holds the needle, for people. */
export type PhaseKind = "outside" | "sticking" | "in" | "out" | "through" | "barred";

export interface PhaseWords {
  readonly kind: PhaseKind;
  /** Tells the phases apart without colour. */
  readonly symbol: string;
  readonly word: string;
  /** What the needle does besides; "" where the word says it all. */
  readonly detail: string;
}

const MOTIONS = ["", "sticking", "sliding in", "sliding out"] as const;
const PLAIN: readonly PhaseWords[] = [
  { kind: "outside", symbol: "○", word: "outside", detail: "" },
  { kind: "sticking", symbol: "■", word: "sticking", detail: "" },
  { kind: "in", symbol: "▼", word: "sliding in", detail: "" },
  { kind: "out", symbol: "▲", word: "sliding out", detail: "" },
  { kind: "barred", symbol: "✕", word: "barred", detail: "" },
];
const THROUGH: readonly PhaseWords[] = MOTIONS.map((detail) => ({
  kind: "through",
  symbol: "◆",
  word: "through",
  detail,
}));

/**
 * phase: 0 to 4, Phase of core/punctura/proxy/solver.hpp. A tip inside and at least `through` deep has the membrane
 * behind
 * it, whatever it does there.
 */
export function phaseWords(phase: number, depth: number, through: number): PhaseWords {
  if (phase >= 1 && phase <= 3 && depth >= through) return THROUGH[phase]!;
  return PLAIN[phase] ?? PLAIN[0]!;
}
