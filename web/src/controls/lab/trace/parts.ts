import { element } from "../../../panel.ts";
import type { FitLine, RivalsLine, TraceLine } from "../../../wire/messages.ts";
import { estimatesTable, rivalsTable, triedTable } from "./tables.ts";
import { doubtWords, withoutOptions } from "./words.ts";

const section = (title: string, ...parts: readonly (Node | string)[]): HTMLElement =>
  element("section", {}, element("h3", {}, title), ...parts);

const list = (sentences: readonly string[]): HTMLElement =>
  element("ul", { class: "trace-list" }, ...sentences.map((text) => element("li", {}, text)));

export const findingsPart = ({ findings: found, samples }: TraceLine): HTMLElement =>
  section(
    "Found in the trace",
    found.length
      ? list(found.map(({ kind, text }) => `${kind.replaceAll("_", " ")}: ${withoutOptions(text)}`))
      : element("p", { class: "quiet" }, `Nothing unusual in ${samples} samples.`),
  );

export function fitParts(fit: FitLine): HTMLElement[] {
  const count = Math.round(fit.effective_samples);
  return [
    section(
      "Parameters",
      estimatesTable(fit.estimates),
      element(
        "p",
        { class: "quiet" },
        `The intervals count ${count} of the samples as independent: neighbouring residuals may be alike. They hold ` +
          "if the model is right; residuals with a shape say that it is not.",
      ),
    ),
    section(
      "What the trace cannot tell",
      fit.verdicts.length ? list(fit.verdicts.map(doubtWords)) : element("p", {}, "Nothing: all is identifiable."),
    ),
    element("details", {}, element("summary", {}, "Extensions that were tried"), triedTable(fit.tried)),
  ];
}

export const rivalsPart = (line: RivalsLine): HTMLElement =>
  section("Other models", ...(line.rows.length ? [rivalsTable(line)] : []), list(line.notes));
