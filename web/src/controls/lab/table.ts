import { element } from "../../panel.ts";
import type { LabComparison, Statistics } from "../../wire/messages.ts";
import { shortNames } from "./fields.ts";

type LabNumber = Exclude<keyof Statistics, "name" | "pops">;
/** The columns: the number, its heading, and the factor from SI to the heading's unit. */
type Column = readonly [name: LabNumber, head: string, gain: number, places: number];
const COLUMNS: readonly Column[] = [
  ["peak", "peak model force, N", 1, 3],
  ["felt_peak", "peak felt force, N", 1, 3],
  ["drop", "largest drop, N", 1, 3],
  ["overshoot", "overshoot, mm", 1e3, 2],
  ["work", "work, mJ", 1e3, 2],
  ["duration", "duration, s", 1, 2],
  ["thumb_peak", "thumb, model force, N", 1, 2],
  ["pressure_peak", "pressure, kPa", 1e-3, 1],
  ["plunger_travel", "plunger, mm", 1e3, 1],
];

/** Only runs with a syringe have these. */
const OF_PLUNGER: readonly LabNumber[] = ["thumb_peak", "pressure_peak", "plunger_travel"];

const minus = (text: string): string => text.replace("-", "−");
const numberText = (value: number | null, gain: number, places: number): string =>
  value === null ? "–" : minus((value * gain).toFixed(places));
const signed = (value: number, gain: number, places: number): string =>
  `${value >= 0 ? "+" : ""}${minus((value * gain).toFixed(places))}`;

/** The numbers of each run with their difference to the first, and their mean and standard deviation. */
export function labTable({ statistics, differences, summary }: LabComparison): HTMLElement {
  const names = shortNames(statistics.map(({ name }) => name));
  const columns = COLUMNS.filter(([name]) => !OF_PLUNGER.includes(name) || summary[name]!.n > 0);
  const rows = statistics.map((run, row) =>
    element(
      "tr",
      {},
      element("th", { scope: "row" }, names[row]!),
      ...columns.map(([name, , gain, places]) => {
        const more = differences[row]?.[name] ?? null;
        const words =
          row && more !== null ? [" ", element("span", { class: "quiet" }, signed(more, gain, places))] : [];
        return element("td", {}, numberText(run[name], gain, places), ...words);
      }),
    ),
  );
  const whole = columns.map(([name, , gain, places]) => {
    const { n, mean, deviation } = summary[name]!;
    const count = n === statistics.length ? "" : ` (n = ${n})`;
    const text = `${numberText(mean, gain, places)} ± ${numberText(deviation, gain, places)}${count}`;
    return element("td", {}, n > 1 ? text : "–");
  });
  return element(
    "div",
    { class: "lab-table", tabindex: 0, role: "region", "aria-label": "Numbers of the runs" },
    element(
      "table",
      {},
      element(
        "thead",
        {},
        element(
          "tr",
          {},
          element("th", { scope: "col" }, "run"),
          ...columns.map(([, head]) => element("th", { scope: "col" }, head)),
        ),
      ),
      element(
        "tbody",
        {},
        ...rows,
        element(
          "tr",
          { class: "mean" },
          element("th", { scope: "row" }, `mean ± s.d. (n = ${statistics.length})`),
          ...whole,
        ),
      ),
    ),
  );
}
