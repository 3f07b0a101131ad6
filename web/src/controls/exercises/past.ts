import { element, named } from "../../panel.ts";
import type { App } from "../../state/app.ts";
import type { Result } from "../../wire/messages.ts";
import { saveAddress } from "../download.ts";
import { dateText } from "../recordings/words.ts";
import { verdict } from "./goals.ts";
import type { Person } from "./person.ts";
import { progressPart } from "./progress_part.ts";

/** Formats of an export, and the endings of their files. */
const FORMATS = [
  ["json", "json"],
  ["csv", "csv"],
  ["xapi", "xapi.jsonl"],
] as const;

/** The results of a person or of the person's class, latest first, and the progress over the attempts. */
export function pastResults(
  app: App,
  open: (result: Result) => void,
  titleOf: (result: Result) => string,
): { root: HTMLElement; show(person: Person): Promise<void> } {
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
  const progress = progressPart(app, titleOf);
  const whole = element("input", { type: "checkbox", id: "whole-class" });
  const scope = element(
    "div",
    { class: "whole-class" },
    whole,
    element("label", { for: "whole-class" }, "Whole class"),
  );
  const root = element(
    "section",
    { class: "past-results" },
    element("h3", {}, "Results"),
    scope,
    note,
    progress.root,
    table,
    exports,
  );
  let asked = 0;
  let last: Person | null = null;
  whole.addEventListener("change", () => {
    if (last) void show(last);
  });
  const show = async (who: Person): Promise<void> => {
    last = who;
    const mine = ++asked;
    const group = who.group.value;
    scope.hidden = group === "";
    const all = group !== "" && whole.checked;
    const query = all ? `group=${encodeURIComponent(group)}` : `person=${encodeURIComponent(who.name.value)}`;
    const whose = all ? `the class ${group}` : who.name.value || "attempts without a name";
    let results: Result[] = [];
    let words = "No results yet.";
    try {
      results = await app.api.json<Result[]>(`/api/results?${query}`);
      if (results.length) words = `Results of ${whose}, kept on this computer.`;
    } catch (error) {
      words = `Cannot load the results: ${error instanceof Error ? error.message : String(error)}`;
    }
    if (mine !== asked) return; // an answer to an earlier question
    note.textContent = words;
    table.hidden = results.length === 0;
    exports.hidden = results.length === 0;
    progress.show(results);
    body.replaceChildren(...results.map((result) => row(result, titleOf(result), all, open)));
    exports.replaceChildren("Save all as");
    for (const [format, ending] of FORMATS)
      exports.append(
        element(
          "button",
          {
            type: "button",
            class: "link",
            onclick: () =>
              saveAddress(app.api.address(`/api/results/download?${query}&format=${format}`), `results.${ending}`),
          },
          format,
        ),
      );
  };
  return { root, show };
}

function row(result: Result, title: string, withPerson: boolean, open: (result: Result) => void): HTMLElement {
  const when = element("button", { type: "button", class: "link", onclick: () => open(result) }, dateText(result.date));
  return element(
    "tr",
    {},
    element("td", {}, when),
    element("td", {}, named(element("span"), withPerson ? `${result.person || "no name"}: ${title}` : title)),
    element("td", { class: result.passed ? "passed" : "failed" }, verdict(result)),
  );
}
