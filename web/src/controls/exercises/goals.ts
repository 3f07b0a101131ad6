import { element } from "../../panel.ts";
import type { ExerciseResult } from "../../wire/files.ts";
import type { ExerciseGoal } from "../../wire/messages.ts";

const STATES = {
  open: ["○", "open"],
  met: ["✓", "met"],
  missed: ["✕", "missed"],
  "not measured": ["?", "not-measured"],
} as const;

/** A goal's state for people: the file's word is "open" where nothing is decided yet. */
export const stateWord = (state: ExerciseGoal["state"]): string => (state === "open" ? "not decided" : state);

/** Goals with their state as a sign, a colour and, for a screen reader, a word. */
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
        // A grid's cells: the sign, and all of the words.
        element("span", {}, text, ...(state === "not measured" ? [element("em", {}, " (not measured)")] : [])),
      );
    }),
  );
}

/** Passed or not; a pass says if something was not measured. */
export function verdict({ passed, goals }: Pick<ExerciseResult, "passed" | "goals">): string {
  if (!passed) return "✕ not passed";
  return goals.some(({ state }) => state === "not measured") ? "✓ passed, but not everything was measured" : "✓ passed";
}
