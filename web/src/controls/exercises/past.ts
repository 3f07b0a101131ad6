import { element } from "../../panel.ts";
import type { App } from "../../state/app.ts";
import type { ExerciseResult } from "../../wire/files.ts";
import { saveAddress } from "../download.ts";
import { dateText } from "../recordings/words.ts";
import { verdict } from "./goals.ts";

/** A person's results, latest first. */
export function pastResults(
  app: App,
  open: (result: ExerciseResult) => void,
  titleOf: (result: ExerciseResult) => string,
): { root: HTMLElement; show(person: string): Promise<void> } {
  const body = element("tbody", {});
  const note = element("p", { class: "quiet" });
  const exports = element("div", { class: "tools quiet" });
  const table = element(
    "table",
    { class: "past" },
    element(
      "thead",
      {},
      element("tr", {}, ...["When", "Exercise", "Result"].map((text) => element("th", { scope: "col" }, text))),
    ),
    body,
  );
  const root = element("section", { class: "past-results" }, element("h3", {}, "Results"), note, table, exports);
  let asked = 0;
  return {
    root,
    show: async (person) => {
      const mine = ++asked;
      const query = `person=${encodeURIComponent(person)}`;
      let results: ExerciseResult[] = [];
      try {
        results = await app.api.json<ExerciseResult[]>(`/api/results?${query}`);
        note.textContent = results.length
          ? `Results of ${person || "attempts without a name"}, kept on this computer.`
          : "No results yet.";
      } catch (error) {
        note.textContent = `Cannot load the results: ${error instanceof Error ? error.message : String(error)}`;
      }
      if (mine !== asked) return;
      table.hidden = results.length === 0;
      exports.hidden = results.length === 0;
      body.replaceChildren(...results.map((result) => row(result, titleOf(result), open)));
      exports.replaceChildren("Save all as");
      for (const format of ["json", "csv"])
        exports.append(
          element(
            "button",
            {
              type: "button",
              class: "link",
              onclick: () =>
                saveAddress(app.api.address(`/api/results/download?${query}&format=${format}`), `results.${format}`),
            },
            format,
          ),
        );
    },
  };
}

function row(result: ExerciseResult, title: string, open: (result: ExerciseResult) => void): HTMLElement {
  const when = element("button", { type: "button", class: "link", onclick: () => open(result) }, dateText(result.date));
  return element(
    "tr",
    {},
    element("td", {}, when),
    element("td", {}, title),
    element("td", { class: result.passed ? "passed" : "failed" }, verdict(result)),
  );
}
