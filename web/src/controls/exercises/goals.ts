import { element } from "../../panel.ts";
import type { ExerciseGoal } from "../../wire/messages.ts";

const STATES = { open: ["○", "open"], met: ["✓", "met"], missed: ["✕", "missed"] } as const;

/** Goals with their state as a sign, a word and a colour. */
export function goalList(goals: readonly ExerciseGoal[]): HTMLElement {
  return element(
    "ul",
    { class: "goals" },
    ...goals.map(({ text, state }) => {
      const [sign, word] = STATES[state];
      return element(
        "li",
        { class: state },
        element("span", { class: "sign", "aria-hidden": "true" }, sign),
        element("span", { class: "only-read" }, `${word}: `),
        text,
      );
    }),
  );
}
