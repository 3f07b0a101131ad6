import { element } from "../../panel.ts";
import type { App } from "../../state/app.ts";
import type { ExerciseResult } from "../../wire/files.ts";
import { ticksOf } from "../editor/law_shape.ts";
import { svg } from "../svg.ts";
import { courses, MEASURES, type Measure, type Point, summaries } from "./progress.ts";

const WIDTH = 320;
const HEIGHT = 150;
const LEFT = 34;
const RIGHT = 8;
const TOP = 8;
const BOTTOM = 28;

/** The course of one measure over the attempts, of one person or of a class, as a chart and a table. */
export function progressPart(
  app: App,
  titleOf: (result: ExerciseResult) => string,
): { root: HTMLElement; show(results: readonly ExerciseResult[]): void } {
  const exercise = element("select", { "aria-label": "Exercise" });
  const measure = element(
    "select",
    { "aria-label": "Measure" },
    ...MEASURES.map(({ key, label }) => element("option", { value: key }, label)),
  );
  const chart = element("div", { class: "progress-chart" });
  const table = element("div", {});
  const root = element(
    "section",
    { class: "progress", hidden: true },
    element("h3", {}, "Progress"),
    element("div", { class: "tools" }, exercise, measure),
    chart,
    table,
  );
  let known: readonly ExerciseResult[] = [];
  const draw = (): void => {
    const chosen = MEASURES.find(({ key }) => key === measure.value) ?? MEASURES[0]!;
    chart.replaceChildren(progressChart(known, exercise.value, chosen));
    table.replaceChildren(progressTable(known, exercise.value, chosen));
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

/** One line a person; a full dot is a pass, an empty one is not. */
export function progressChart(results: readonly ExerciseResult[], exercise: string, measure: Measure): SVGSVGElement {
  const lines = courses(results, exercise, measure);
  const points = lines.flatMap((line) => line.points);
  const most = Math.max(2, ...points.map(({ number }) => number));
  const high = Math.max(...points.map(({ value }) => value), 1e-3) * 1.1;
  const x = (number: number): number => LEFT + ((number - 1) / (most - 1)) * (WIDTH - LEFT - RIGHT);
  const y = (value: number): number => HEIGHT - BOTTOM - (value / high) * (HEIGHT - TOP - BOTTOM);
  const words = `${measure.label} over ${points.length} attempts; smaller is better.`;
  const drawing = svg("svg", { viewBox: `0 0 ${WIDTH} ${HEIGHT}`, role: "img" }, svg("title", {}, words));
  for (const value of ticksOf(0, high, 4)) {
    drawing.append(
      svg("line", { x1: LEFT, x2: WIDTH - RIGHT, y1: y(value), y2: y(value) }),
      svg("text", { x: LEFT - 4, y: y(value) + 3, "text-anchor": "end" }, String(value)),
    );
  }
  for (const number of ticksOf(1, most, 6).filter(Number.isInteger))
    drawing.append(svg("text", { x: x(number), y: HEIGHT - BOTTOM + 12, "text-anchor": "middle" }, String(number)));
  drawing.append(
    svg("text", { x: (LEFT + WIDTH) / 2, y: HEIGHT - 3, "text-anchor": "middle" }, "attempt (● passed, ○ not passed)"),
  );
  lines.forEach((line, i) => {
    const path = line.points.map((point) => `${x(point.number).toFixed(1)},${y(point.value).toFixed(1)}`).join("L");
    const group = svg("g", { class: `person-${(i % 5) + 1}` }, svg("path", { d: path ? `M${path}` : "" }));
    group.append(...line.points.map((point) => dot(point, line.person, x(point.number), y(point.value))));
    drawing.append(group);
  });
  return drawing;
}

function dot({ number, value, result }: Point, person: string, cx: number, cy: number): SVGElement {
  const words = `${person || "no name"}, attempt ${number}: ${value.toFixed(2)}, ${result.passed ? "" : "not "}passed`;
  const kind = result.passed ? "passed" : "failed";
  return svg("circle", { class: kind, cx: cx.toFixed(1), cy: cy.toFixed(1), r: 3.5 }, svg("title", {}, words));
}

function progressTable(results: readonly ExerciseResult[], exercise: string, measure: Measure): HTMLElement {
  const number = (value: number | null): string => (value === null ? "–" : value.toFixed(2));
  const head = ["Name", "Attempts", "Passed", "First pass", "Best", "Last"];
  return element(
    "table",
    { class: "past" },
    element("caption", { class: "only-read" }, `Attempts by person; best and last: ${measure.label}`),
    element("thead", {}, element("tr", {}, ...head.map((text) => element("th", { scope: "col" }, text)))),
    element(
      "tbody",
      {},
      ...summaries(results, exercise, measure).map((row, i) =>
        element(
          "tr",
          {},
          element("th", { scope: "row", class: `person-${(i % 5) + 1}` }, row.person || "no name"),
          ...[
            String(row.attempts),
            String(row.passed),
            row.firstPass === null ? "–" : `no. ${row.firstPass}`,
            number(row.best),
            number(row.last),
          ].map((text) => element("td", {}, text)),
        ),
      ),
    ),
  );
}
