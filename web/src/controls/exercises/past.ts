import { errorText } from "../../format.ts";
import { button, element, keptList, named } from "../../panel.ts";
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
  let query = "";
  const exports = element(
    "div",
    { class: "tools quiet" },
    "Save all as",
    ...FORMATS.map(([format, ending]) => {
      const address = (): string => app.api.address(`/api/results/download?${query}&format=${format}`);
      const act = (): void => saveAddress(address(), `results.${ending}`);
      return button(format, "", act, "link");
    }),
  );
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
  const showRows = keptList<Row>(body, (one) => row(one, open));
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
    query = all ? `group=${encodeURIComponent(group)}` : `person=${encodeURIComponent(who.name.value)}`;
    const whose = all ? `the class ${group}` : who.name.value || "attempts without a name";
    let results: Result[] = [];
    let words = "No results yet.";
    try {
      results = await app.api.json<Result[]>(`/api/results?${query}`);
      if (results.length) words = `Results of ${whose}, kept on this computer.`;
    } catch (error) {
      words = `Cannot load the results: ${errorText(error)}`;
    }
    if (mine !== asked) return; // an answer to an earlier question
    note.textContent = words;
    table.hidden = results.length === 0;
    exports.hidden = results.length === 0;
    progress.show(results);
    showRows(results.map((result) => ({ result, title: titleOf(result), withPerson: all })));
  };
  return { root, show };
}

interface Row {
  readonly result: Result;
  readonly title: string;
  readonly withPerson: boolean;
}

function row({ result, title, withPerson }: Row, open: (result: Result) => void): HTMLElement {
  const when = button(dateText(result.date), "", () => open(result), "link");
  return element(
    "tr",
    {},
    element("td", {}, when),
    element("td", {}, named(element("span"), withPerson ? `${result.person || "no name"}: ${title}` : title)),
    element("td", { class: result.passed ? "passed" : "failed" }, verdict(result)),
  );
}
