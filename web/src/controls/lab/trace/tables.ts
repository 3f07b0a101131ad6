import { fixedNumber } from "../../../format.ts";
import { element } from "../../../panel.ts";
import type { EstimatePart, RivalsLine, TriedPart } from "../../../wire/messages.ts";
import { estimateWords, parameterWords } from "./words.ts";

type Cell = Node | string;
const HALF = 0.5; // share of the value that an error bar can show on either side

function table(label: string, head: readonly string[], rows: readonly HTMLElement[]): HTMLElement {
  return element(
    "div",
    { class: "lab-table", tabindex: 0, role: "region", "aria-label": label },
    element(
      "table",
      {},
      element("thead", {}, element("tr", {}, ...head.map((words) => element("th", { scope: "col" }, words)))),
      element("tbody", {}, ...rows),
    ),
  );
}

const row = (kind: string, name: string, ...cells: readonly Cell[]): HTMLElement =>
  element(
    "tr",
    { class: kind },
    element("th", { scope: "row" }, name),
    ...cells.map((cell) => element("td", {}, cell)),
  );

/** Every parameter with its value, its interval, and a bar for the interval as a part of the value. */
export function estimatesTable(estimates: readonly EstimatePart[]): HTMLElement {
  const rows = estimates.map((estimate) => {
    const { value, interval, relative } = estimateWords(estimate);
    const text = estimate.identifiable ? relative : "not told by this trace";
    return row(
      estimate.identifiable ? "" : "unidentifiable",
      parameterWords(estimate.name),
      value,
      interval,
      text,
      relative || !estimate.identifiable ? bar(estimate) : "",
    );
  });
  return table("Parameters", ["parameter", "value", "95 % interval", "half of it", "−50 % to 50 %"], rows);
}

function bar({ value, low, high }: EstimatePart): HTMLElement {
  const share = (bound: number | null, open: number): number =>
    bound === null || value === 0 ? open : Math.max(-HALF, Math.min(HALF, (bound - value) / Math.abs(value)));
  const [from, to] = [share(low, -HALF), share(high, HALF)];
  const made = element("span", { class: "error-bar", "aria-hidden": "true" }, element("i"));
  made.style.setProperty("--from", String((from + HALF) / (2 * HALF)));
  made.style.setProperty("--to", String((to + HALF) / (2 * HALF)));
  return made;
}

const number = (value: number | null, gain: number, places: number): string =>
  fixedNumber(value === null ? undefined : gain * value, places);

/** All models, the one with the least AIC first. */
export function rivalsTable({ rows }: Pick<RivalsLine, "rows">): HTMLElement {
  const least = Math.min(...rows.map(({ aic }) => aic ?? Number.POSITIVE_INFINITY));
  return table(
    "Models",
    ["model", "% of peak", "rms, mN", "held out, mN", "AIC − least", "numbers", "shakes at rest, mN"],
    rows.map((one) =>
      row(
        one.own ? "mean" : "",
        one.converged ? one.title : `${one.title} *`,
        number(one.rmse_share, 100, 2),
        number(one.rmse, 1e3, 1),
        number(one.held_out_rmse, 1e3, 1),
        number(one.aic === null ? null : one.aic - least, 1, 0),
        String(one.parameters),
        number(one.rest, 1e3, 1),
      ),
    ),
  );
}

/** The models that were tried, the chosen one first. */
export function triedTable(tried: readonly TriedPart[]): HTMLElement {
  return table(
    "Models that were tried",
    ["K06 with", "membranes", "numbers", "rms, mN", "held out, mN", "AICc", "BIC"],
    tried.map((one, i) =>
      row(
        i ? "" : "mean",
        one.extensions.join(", ") || "no extension",
        String(one.membranes),
        String(one.parameters),
        number(one.rmse, 1e3, 1),
        number(one.held_out_rmse, 1e3, 1),
        number(one.aicc, 1, 0),
        number(one.bic, 1, 0),
      ),
    ),
  );
}
