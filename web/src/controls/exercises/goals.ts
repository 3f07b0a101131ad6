import { unbroken } from "../../format.ts";
import { element } from "../../panel.ts";
import type { GoalState, Loss, Result } from "../../wire/messages.ts";

const STATES = {
  open: ["○", "open"],
  met: ["✓", "met"],
  missed: ["✕", "missed"],
  "not measured": ["?", "not-measured"],
} as const;

/** The word for a goal's state: "not decided" for "open". */
export const stateWord = (state: GoalState["state"]): string => (state === "open" ? "not decided" : state);

/** A list of goals. A sign, a colour and, for a screen reader, a word show each state. */
export function goalList(goals: readonly GoalState[]): HTMLElement {
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
export function lossText({ before, after, needed }: Pick<Loss, "before" | "after" | "needed">): string {
  const drop = before - after;
  const words = drop > 0 ? `${drop.toFixed(2)} N` : "none";
  return needed === null ? words : `${words}; ${Number(needed.toPrecision(2))} N needed`;
}

/** Passed, not passed, or not judged as passed. A pass of an earlier version tells if a goal was not measured. */
export function verdict({ passed, withheld, goals }: Pick<Result, "passed" | "withheld" | "goals">): string {
  if (withheld) return `◐ not judged as passed: ${withheld}`;
  if (!passed) return "✕ not passed";
  const unmeasured = goals.some(({ state }) => state === "not measured");
  return unmeasured ? "✓ passed, but not everything was measured" : "✓ passed";
}
