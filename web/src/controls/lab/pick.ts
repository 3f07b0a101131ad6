import { button, element, keptList, named } from "../../panel.ts";
import type { RecordingEntry, Result } from "../../wire/messages.ts";
import { dateText, lengthText } from "../recordings/words.ts";

const MOST = 25; // runs, as in the studio

/** The chosen names in the order in which they were chosen, after a box was checked or unchecked. */
export const choose = (chosen: readonly string[], name: string, on: boolean): readonly string[] => [
  ...chosen.filter((other) => other !== name),
  ...(on ? [name] : []),
];

interface Run {
  readonly name: string;
  readonly title: string;
  readonly facts: string;
}

function rowOf({ name, title, seconds, started }: RecordingEntry, results: readonly Result[]): Run {
  const result = results.find(({ recording }) => recording === name);
  const facts = [
    result && `${result.title}: ${result.passed ? "passed" : "not passed"}`,
    result?.person,
    lengthText(seconds),
    dateText(started),
  ];
  return { name, title, facts: facts.filter(Boolean).join(" · ") };
}

/** A list of recordings and results with check boxes, and a button that compares the chosen ones. */
export function pickRuns(act: (names: readonly string[]) => void): {
  readonly root: HTMLElement;
  offer(entries: readonly RecordingEntry[], results: readonly Result[]): void;
} {
  const list = element("ul", { class: "lab-list" });
  const showRows = keptList<Run>(list, ({ name, title, facts }) => {
    const box = element("input", { type: "checkbox", value: name });
    box.checked = chosen.includes(name);
    const words = element("span", {}, named(element("span"), title || name), " ");
    words.append(element("b", { "data-run": name, hidden: true }, "reference "));
    words.append(element("span", { class: "quiet" }, facts));
    return element("li", {}, element("label", {}, box, words));
  });
  const none = element("p", { class: "quiet" }, "No recordings yet. Record a run, or try an exercise.");
  let chosen: readonly string[] = []; // in the order in which they were chosen
  const go = button("Compare", "", () => act(chosen), "small primary");
  const mark = (): void => {
    const count = chosen.length;
    for (const row of list.querySelectorAll<HTMLElement>("[data-run]")) row.hidden = row.dataset.run !== chosen[0];
    go.disabled = count < 1 || count > MOST;
    go.textContent = count ? `Compare ${count} ${count === 1 ? "run" : "runs"}` : "Choose runs to compare";
    if (count > MOST) go.textContent = `At most ${MOST} runs`;
  };
  list.addEventListener("change", ({ target }) => {
    if (target instanceof HTMLInputElement) chosen = choose(chosen, target.value, target.checked);
    mark();
  });
  return {
    root: element(
      "section",
      {},
      element("h3", {}, "Compare runs"),
      element("p", { class: "quiet" }, "The first chosen run is the reference for the differences."),
      none,
      list,
      go,
    ),
    offer: (entries, results) => {
      chosen = chosen.filter((name) => entries.some((entry) => entry.name === name));
      none.hidden = entries.length > 0;
      list.hidden = go.hidden = entries.length === 0;
      showRows(entries.map((entry) => rowOf(entry, results)));
      mark();
    },
  };
}
