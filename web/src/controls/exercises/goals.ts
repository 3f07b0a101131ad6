import { unbroken } from "../../format.ts";
import { element } from "../../panel.ts";
import type { ExerciseResult, FeltLoss, Loss, Yield } from "../../wire/files.ts";
import type { ExerciseGoal } from "../../wire/messages.ts";

const STATES = {
  open: ["○", "open"],
  met: ["✓", "met"],
  missed: ["✕", "missed"],
  "not measured": ["?", "not-measured"],
} as const;

/** The word for a goal's state: "not decided" for "open". */
export const stateWord = (state: ExerciseGoal["state"]): string => (state === "open" ? "not decided" : state);

/** A list of goals. A sign, a colour and, for a screen reader, a word show each state. */
export function goalList(goals: readonly ExerciseGoal[]): HTMLElement {
  return element(
    "ul",
    { class: "goals" },
    ...goals.map(({ text, state }) => {
      const [sign, style] = STATES[state];
      return element(
        "li",
        { class: style },
        element("span", { class: "sign", "aria-hidden": "true" }, sign),
        element("span", { class: "only-read" }, `${stateWord(state)}: `),
        // One element, because the sign and the text are the two cells of a grid.
        element(
          "span",
          {},
          unbroken(text),
          ...(state === "not measured" ? [element("em", {}, " (not measured)")] : []),
        ),
      );
    }),
  );
}

/**
 * The drop of the felt force, and how much of it a hand needs to feel it, if it must: "0.04 N; 0.1 N needed". "none" if
 * the force did not fall: the next layer resists more.
 */
export function lossText({ before, after, needed }: FeltLoss): string {
  const drop = before - after;
  const words = drop > 0 ? `${drop.toFixed(2)} N` : "none";
  return needed === null ? words : `${words}; ${Number(needed.toPrecision(2))} N needed`;
}

/**
 * Of the losses that must be felt, the smallest one that could not be. Of each membrane its last pop counts, and of the
 * plunger the last time that it gave way.
 */
export function unfelt(losses: readonly Loss[], yields: readonly Yield[] = []): FeltLoss | null {
  const last = new Map(losses.filter(({ needed }) => needed !== null).map((loss) => [loss.membrane, loss]));
  const plunger = yields.flatMap(({ loss }) => (loss && loss.needed !== null ? [loss] : [])).slice(-1);
  const drop = ({ before, after }: FeltLoss): number => before - after;
  const lost = [...last.values(), ...plunger].filter((loss) => drop(loss) < loss.needed!);
  return lost.sort((a, b) => drop(a) - drop(b))[0] ?? null;
}

/** Passed, not passed, or not judged as passed. A pass tells if a goal was not measured. */
export function verdict({ passed, goals, metrics }: Pick<ExerciseResult, "passed" | "goals" | "metrics">): string {
  const lost = unfelt(metrics.losses ?? [], metrics.yields ?? []);
  const achieved = goals.every(({ state }) => state === "met" || state === "not measured");
  if (!passed && achieved && lost)
    return `◐ not judged as passed: the device could not show the loss of resistance (${lossText(lost)})`;
  if (!passed) return "✕ not passed";
  const unmeasured = goals.some(({ state }) => state === "not measured");
  return unmeasured ? "✓ passed, but not everything was measured" : "✓ passed";
}
