import { element } from "../../panel.ts";
import type { ExerciseResult } from "../../wire/files.ts";
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
        element("span", {}, text, ...(state === "not measured" ? [element("em", {}, " (not measured)")] : [])),
      );
    }),
  );
}

/** Passed or not passed. A pass tells if a goal was not measured. */
export function verdict({ passed, goals }: Pick<ExerciseResult, "passed" | "goals">): string {
  if (!passed) return "✕ not passed";
  const unmeasured = goals.some(({ state }) => state === "not measured");
  return unmeasured ? "✓ passed, but not everything was measured" : "✓ passed";
}
