import { element } from "../../panel.ts";
import { drawAxes, MARGIN, Pane } from "../../plots/kit/axes.ts";
import { Figure } from "../../plots/kit/figure.ts";
import type { Pen } from "../../plots/kit/pen.ts";
import { Polyline } from "../../plots/kit/polyline.ts";
import { CSS_THEME, colourOf, type Theme } from "../../plots/kit/theme.ts";
import type { App } from "../../state/app.ts";
import type { Result } from "../../wire/messages.ts";

const HEIGHT = 180; // px
const nameOf = (person: string): string => person || "no name";

/** The course of one measure over the attempts, of one person or of a class, as a chart and a table. */
export function progressPart(
  app: App,
  titleOf: (result: Result) => string,
): { root: HTMLElement; show(results: readonly Result[]): void } {
  const exercise = element("select", { "aria-label": "Exercise" });
  const measure = element(
    "select",
    { "aria-label": "Measure" },
    ...MEASURES.map(({ key, label }) => element("option", { value: key }, label)),
  );
  let known: readonly Result[] = [];
  const chosen = (): Measure => MEASURES.find(({ key }) => key === measure.value) ?? MEASURES[0]!;
  const chart = new Figure("progress-chart", HEIGHT, (pen, width, height, theme) =>
    drawProgress(pen, width, height, theme, known, exercise.value, chosen()),
  );
  const table = element("div", {});
  const root = element(
    "section",
    { class: "progress", hidden: true },
    element("h3", {}, "Progress"),
    element("div", { class: "tools" }, exercise, measure),
    chart.root,
    table,
  );
  const draw = (): void => {
    chart.redraw();
    table.replaceChildren(progressTable(known, exercise.value, chosen()));
  };
  exercise.addEventListener("change", draw);
  measure.addEventListener("change", draw);
  return {
    root,
    show: (results) => {
      known = results;
      root.hidden = results.length === 0;
      const before = exercise.value;
      const names = [...new Set(results.map((result) => result.exercise))];
      exercise.replaceChildren(
        ...names.map((name) =>
          element("option", { value: name }, titleOf(results.find((result) => result.exercise === name)!)),
        ),
      );
      // After an attempt the exercise of this attempt, the latest, is shown.
      exercise.value =
        app.exercise.value?.exercise && names.includes(app.exercise.value.exercise)
          ? app.exercise.value.exercise
          : names.includes(before)
            ? before
            : (names[0] ?? "");
      draw();
    },
  };
}

/**
 * One line a person, with the name at its end; a full dot is a pass, an empty one is not. Returns what a screen reader
 * says.
 */
export function drawProgress(
  pen: Pen,
  width: number,
  height: number,
  theme: Theme,
  results: readonly Result[],
  exercise: string,
  measure: Measure,
): string {
  const lines = courses(results, exercise, measure);
  const points = lines.flatMap((line) => line.points);
  const pane = new Pane();
  pane.place(MARGIN.left, MARGIN.top, width - MARGIN.left - MARGIN.right, height - MARGIN.top - MARGIN.bottom);
  pane.rangeX(0.5, Math.max(2, ...points.map(({ number }) => number)) + 0.5);
  pane.rangeY(0, 1.25 * Math.max(0, ...points.map(({ value }) => value)) || 1);
  drawAxes(pen, pane, theme, { x: "attempt (full: passed, empty: not passed)", y: measure.label }, 1);
  lines.forEach((line, i) => {
    const colour = colourOf(theme, i);
    const path = new Polyline(16);
    for (const { number, value } of line.points) path.add(pane.x.px(number), pane.y.px(value));
    pen.line(path, { colour, width: 1.4 });
    for (const { number, value, result } of line.points) {
      const [x, y] = [pane.x.px(number), pane.y.px(value)];
      pen.dot(x, y, 4, colour, theme.panel);
      if (!result.passed) pen.dot(x, y, 2, theme.panel, theme.panel);
    }
    const end = line.points.at(-1);
    if (!end) return;
    const x = pane.x.px(end.number);
    const anchor = x > pane.left + pane.width / 2 ? "end" : "start"; // the name stays inside
    pen.text(x, pane.y.px(end.value) - 11, nameOf(line.person), { colour, anchor, bold: true, halo: theme.panel });
  });
  return `${measure.label} over ${points.length} attempts. Smaller is better.`;
}

function progressTable(results: readonly Result[], exercise: string, measure: Measure): HTMLElement {
  const number = (value: number | null): string => (value === null ? "–" : value.toFixed(2));
  const head = ["Name", "Attempts", "Passed", "First pass", "Best pass", "Last"];
  return element(
    "table",
    { class: "past" },
    element("caption", { class: "only-read" }, `Attempts by person; best pass and last: ${measure.label}`),
    element("thead", {}, element("tr", {}, ...head.map((text) => element("th", { scope: "col" }, text)))),
    element(
      "tbody",
      {},
      ...summaries(results, exercise, measure).map((row, i) => {
        const who = element("th", { scope: "row" }, nameOf(row.person));
        who.style.color = colourOf(CSS_THEME, i);
        return element(
          "tr",
          {},
          who,
          ...[
            String(row.attempts),
            String(row.passed),
            row.firstPass === null ? "–" : `no. ${row.firstPass}`,
            number(row.best),
            number(row.last),
          ].map((text) => element("td", {}, text)),
        );
      }),
    ),
  );
}

/** A measure whose course over the attempts is shown. In the unit of its label; smaller is better. */
export interface Measure {
  readonly key: string;
  readonly label: string;
  readonly of: (result: Result) => number | null;
}

export const MEASURES: readonly Measure[] = [
  { key: "overshoot", label: "Largest overshoot, mm", of: ({ metrics }) => largest(metrics.overshoot) },
  { key: "force", label: "Peak model force, N", of: ({ metrics }) => metrics.peak_force },
  { key: "time", label: "Total time, s", of: ({ metrics }) => metrics.total_time },
  { key: "arrival", label: "Time to the space, s", of: ({ metrics }) => metrics.time_to_target },
  { key: "entries", label: "Entries", of: ({ metrics }) => metrics.entries },
  { key: "aside", label: "Lateral deviation, mm", of: ({ metrics }) => times(metrics.lateral_deviation, 1e3) },
];

const largest = (overshoot: readonly { readonly distance: number }[]): number | null =>
  overshoot.length ? Math.max(...overshoot.map(({ distance }) => distance)) * 1e3 : null;
const times = (value: number | null, factor: number): number | null => (value === null ? null : value * factor);

/** One attempt in the chart. */
export interface Point {
  /** 1 for the first attempt of the person. */
  readonly number: number;
  readonly value: number;
  readonly result: Result;
}

/** The attempts of each person at one exercise, the oldest first. Attempts without the measure are left out. */
export function courses(
  results: readonly Result[],
  exercise: string,
  { of }: Measure,
): { person: string; points: Point[] }[] {
  return byPerson(results.filter((result) => result.exercise === exercise)).map(([person, attempts]) => ({
    person,
    points: attempts.flatMap((result, i) => {
      const value = of(result);
      return value === null ? [] : [{ number: i + 1, value, result }];
    }),
  }));
}

/** One row of the table. */
export interface Summary {
  readonly person: string;
  readonly attempts: number;
  readonly passed: number;
  /** Number of the attempt that passed first; null: none. */
  readonly firstPass: number | null;
  /** Of the attempts that were passed: one that was given up at once has the least time and force. */
  readonly best: number | null;
  readonly last: number | null;
}

/** What each person achieved at one exercise. */
export function summaries(results: readonly Result[], exercise: string, measure: Measure): Summary[] {
  return byPerson(results.filter((result) => result.exercise === exercise)).map(([person, attempts]) => {
    const values = attempts.map(measure.of).filter((value) => value !== null);
    const good = attempts.filter(({ passed }) => passed).map(measure.of);
    const best = good.filter((value) => value !== null);
    const first = attempts.findIndex(({ passed }) => passed);
    return {
      person,
      attempts: attempts.length,
      passed: good.length,
      firstPass: first < 0 ? null : first + 1,
      best: best.length ? Math.min(...best) : null,
      last: values.at(-1) ?? null,
    };
  });
}

/** Results by person in alphabetical order; of each person the oldest first. */
function byPerson(results: readonly Result[]): [string, Result[]][] {
  const people = new Map<string, Result[]>();
  for (const result of results) people.set(result.person, [...(people.get(result.person) ?? []), result]);
  for (const attempts of people.values()) attempts.sort((a, b) => a.date.localeCompare(b.date));
  return [...people].sort(([a], [b]) => a.localeCompare(b));
}
