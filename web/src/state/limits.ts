import limits from "../wire/limit_words.json";
import { wordsOf } from "../wire/ticks.ts";
import type { History } from "./history.ts";
import { sizeOf } from "./scale.ts";

/** By the codes of the `limit` column. */
export const LIMITS = wordsOf("limit");
/** Recordings of earlier versions do not say which limit acted. */
export type Limit = (typeof LIMITS)[number] | "unknown";

/** The limit that cut the force, in a word or two. */
export const LIMIT_WORDS: Readonly<Record<Limit, string>> = { ...limits.words, unknown: "" };

/** Whether a limit cuts the force below the model's. The ramp after arming does not count. */
export const cuts = (limit: Limit): boolean => limits.cuts.includes(limit);

/** The limit that acted in a tick; recordings of earlier versions do not say. */
export const limitOf = (history: History, tick: number): Limit =>
  LIMITS[history.byteRow("limit", tick)[0] ?? 0] ?? "unknown";

/** The last tick, not before `first`, in which a limit cut the force; null if there is none. */
export function lastCut(history: History, first: number): number | null {
  const limits = history.byteColumn("limit");
  for (let tick = history.end - 1; tick >= Math.max(first, history.first); tick--)
    if (cuts(LIMITS[limits[history.slot(tick)]!] ?? "unknown")) return tick;
  return null;
}

const HELD = 800; // ticks: a cut is told for this long, so that it can be read

/** The last tick in which a limit cut the force, if that was just now; null if not. */
export const cutJustNow = (history: History): number | null => lastCut(history, history.end - HELD);

const REMEDIES: Readonly<Partial<Record<Limit, string>>> = {
  peak: "Push more gently.",
  continuous: "Draw back a little for some seconds, then it comes back.", // at rest, friction holds the needle
  temperature: "Draw the needle out, and let the motors cool.",
};

/** For a learner: that a limit cut the force in a tick, why, and what to do. */
export function cutSentence(history: History, tick: number): string {
  const limit = limitOf(history, tick);
  return `Force cut: ${LIMIT_WORDS[limit]}, ${cutFigures(history, tick)}. ${REMEDIES[limit] ?? ""}`.trim();
}

/** "0.76 of 2.19 N": the felt force in a tick, and what it would be without the limit. */
export function cutFigures(history: History, tick: number): string {
  const scale = history.row("force_scale", tick)[0] ?? 1;
  const wanted = scale * sizeOf(history, "model_force", tick);
  return `${sizeOf(history, "force", tick).toFixed(2)} of ${wanted.toFixed(2)} N`;
}
