import { element } from "../../panel.ts";
import { drawAxes, MARGIN, Pane } from "../../plots/kit/axes.ts";
import { decimate } from "../../plots/kit/decimate.ts";
import { Figure } from "../../plots/kit/figure.ts";
import { apart, labelsThatFit, textWidth } from "../../plots/kit/labels.ts";
import type { Pen, Stroke } from "../../plots/kit/pen.ts";
import { Polyline } from "../../plots/kit/polyline.ts";
import { colourOf, type Theme } from "../../plots/kit/theme.ts";
import type { Result } from "../../wire/messages.ts";
import { contactOf } from "./expert.ts";
import { peakText } from "./metrics.ts";
import { indexAt, type Layer, type Trace } from "./trace.ts";

const HEIGHT = 340; // px
const ROWS = 26; // px above the upper pane: two rows of labels
const DEPTH_SHARE = 0.6;
/** The drawing begins this long before the first contact, s. */
export const BEFORE = 0.5;
const BELOW = 2e-3; // m: drawn depth of a space without an end
const MM = 1e3;

/** Draws depth and model force of an attempt over time, with layers, the space to reach, pops and the peak force. */
export function traceDrawing(
  trace: Trace,
  layers: readonly Layer[],
  space: Layer | null,
  result: Result,
  expert: Trace | null = null,
): HTMLElement {
  const figure = new Figure("trace", HEIGHT, (pen, width, height, theme) => {
    drawTrace(pen, width, height, theme, trace, layers, space, result, expert);
    return wordsOf(result);
  });
  return element(
    "figure",
    { class: "trace-figure" },
    figure.root,
    element(
      "figcaption",
      { class: "quiet" },
      ...(expert ? ["Dashed: the expert’s run, from its first contact on. "] : []),
      trace.tip > 0
        ? "The line is the depth of the point, the band above it the rest of the tip, as the goals judge them: " +
            "a wall that the tip only pushes ahead is still in front of it."
        : "This is the tip’s depth. Goals use the model’s depth: the tip pushes a wall ahead before it pierces it.",
    ),
  );
}

function drawTrace(
  pen: Pen,
  width: number,
  height: number,
  theme: Theme,
  trace: Trace,
  layers: readonly Layer[],
  space: Layer | null,
  result: Result,
  expert: Trace | null = null,
): void {
  const touch = result.events.find(({ what }) => what === "touch")?.time ?? trace.time[0] ?? 0;
  const from = indexAt(trace.time, touch - BEFORE);
  const to = endOf(trace, result, touch);
  const start = trace.time[from] ?? 0;
  const end = Math.max(trace.time[to - 1] ?? 1, start + 1e-3);

  const [depth, force] = [new Pane(), new Pane()];
  const names = Math.max(...layers.map(({ name }) => textWidth(name)), textWidth("to reach"));
  const side = Math.min(names + 10, 0.3 * width);
  const room = height - ROWS - 2 * MARGIN.top - MARGIN.bottom;
  depth.place(MARGIN.left, ROWS + MARGIN.top, width - MARGIN.left - side, DEPTH_SHARE * room);
  force.place(MARGIN.left, depth.bottom + MARGIN.top, depth.width, room - depth.height);
  for (const pane of [depth, force]) pane.rangeX(start - touch, end - touch);

  const deepest = Math.max(...layers.map(({ bottom }) => bottom), 0) * MM;
  const reached = extreme(trace.depth, from, to, Math.max) * MM;
  const shallow = Math.max(-4, Math.min(extreme(trace.depth, from, to, Math.min) * MM, -1));
  const wanted = space ? Math.min(space.bottom, space.top + BELOW) * MM : 0;
  const low = Math.max(deepest, reached, wanted) * 1.06;
  depth.rangeY(low, shallow); // deeper is lower
  const strongest = Math.max(extreme(trace.force, from, to, Math.max), 0.1);
  force.rangeY(Math.min(extreme(trace.force, from, to, Math.min), 0), 1.15 * strongest);

  drawLayers(pen, depth, layers, space && { ...space, bottom: Math.min(space.bottom, low / MM) }, theme);
  drawAxes(pen, depth, theme, { y: "depth (mm)" });
  drawAxes(pen, force, theme, { x: "time since the first contact (s)", y: "model force (N)" });
  drawMarks(pen, depth, force, result, touch, end, theme);
  const line = (pane: Pane, values: Float64Array, gain: number, stroke: Stroke): void => {
    const xs = Float32Array.from(trace.time.subarray(from, to), (time) => pane.x.px(time - touch));
    const ys = Float32Array.from(values.subarray(from, to), (value) => pane.y.px(gain * value));
    const path = new Polyline();
    decimate(xs, ys, 0, to - from, path);
    pen.within(pane.left, pane.top, pane.width, pane.height, () => pen.line(path, stroke));
  };
  if (expert) drawExpert(pen, depth, force, expert, theme);
  drawTip(pen, depth, trace, from, to, touch, theme);
  line(depth, trace.depth, MM, { colour: theme.text, width: 1.6 });
  line(force, trace.force, 1, { colour: colourOf(theme, 0), width: 1.6 });
  const peak = indexOfMost(trace.force, from, indexAt(trace.time, touch + result.metrics.total_time));
  if (peak === null) return;
  const [px, py] = [force.x.px(trace.time[peak]! - touch), force.y.px(trace.force[peak]!)];
  pen.dot(px, py, 3.5, colourOf(theme, 0), theme.panel);
  const text = peakText(result);
  const left = Math.min(px + 7, width - textWidth(text));
  pen.text(left, py, text, { colour: colourOf(theme, 0), bold: true, halo: theme.panel });
}

/** From the end of the slanted face to the point: goals for the whole tip ask for all of it. */
function drawTip(pen: Pen, pane: Pane, trace: Trace, from: number, to: number, touch: number, theme: Theme): void {
  if (trace.tip === 0) return;
  const area = new Polyline();
  const add = (i: number, above: number): void => {
    const y = pane.y.px(MM * (trace.depth[i]! - above));
    if (Number.isFinite(y)) area.add(pane.x.px(trace.time[i]! - touch), y);
  };
  for (let i = from; i < to; i++) add(i, 0);
  for (let i = to - 1; i >= from; i--) add(i, trace.tip);
  pen.within(pane.left, pane.top, pane.width, pane.height, () => pen.area(area, theme.text, 0.16));
}

/** The drawing ends with the decision, as the measures do. */
function endOf({ time }: Trace, { metrics }: Result, touch: number): number {
  return metrics.total_time > 0 ? Math.min(indexAt(time, touch + metrics.total_time) + 1, time.length) : time.length;
}

/** The expert's curves, dashed, as far as the attempt lasts. */
function drawExpert(pen: Pen, depth: Pane, force: Pane, expert: Trace, theme: Theme): void {
  const contact = contactOf(expert);
  for (const [pane, values, gain, colour] of [
    [depth, expert.depth, MM, theme.quiet],
    [force, expert.force, 1, colourOf(theme, 3)],
  ] as const) {
    const xs = Float32Array.from(expert.time, (time) => pane.x.px(time - contact));
    const ys = Float32Array.from(values, (value) => pane.y.px(gain * value));
    const path = new Polyline();
    decimate(xs, ys, 0, xs.length, path);
    const stroke = { colour, width: 1.4, dash: [5, 4] };
    pen.within(pane.left, pane.top, pane.width, pane.height, () => pen.line(path, stroke));
  }
}

function drawLayers(pen: Pen, pane: Pane, layers: readonly Layer[], space: Layer | null, theme: Theme): void {
  const box = ({ top, bottom }: Layer, colour: string, alpha: number): number => {
    const [y0, y1] = [pane.y.px(top * MM), pane.y.px(bottom * MM)];
    pen.box(pane.left, y0, pane.width, Math.max(y1 - y0, 1), colour, alpha);
    return (y0 + y1) / 2;
  };
  const green = colourOf(theme, 2);
  const labels = [
    ...(space ? [{ text: "to reach", at: box(space, green, 0.16), colour: green, bold: true }] : []),
    ...layers.map((layer) => ({ text: layer.name, at: box(layer, theme.quiet, 0.22), colour: theme.quiet })),
  ];
  const places = apart(labels.map(({ at }) => at), 12, [pane.top, pane.bottom + 6]); // biome-ignore format: one line
  labels.forEach(({ text, at: _, ...look }, i) => {
    pen.text(pane.right + 6, places[i]!, text, look);
  });
}

/** Lines for the pops, the first arrival in the space and the decision. */
function drawMarks(pen: Pen, depth: Pane, force: Pane, result: Result, touch: number, end: number, theme: Theme): void {
  const { time_to_target: arrival, total_time: total } = result.metrics;
  const [orange, green] = [colourOf(theme, 1), colourOf(theme, 2)];
  const pops = result.events.filter(({ what, time }) => what === "pop" && time <= end);
  const rows = [
    [
      ...(arrival === null ? [] : [{ time: arrival, text: "arrived", colour: green }]),
      ...(total <= 0 ? [] : [{ time: total, text: endWord(result), colour: result.passed ? green : theme.danger }]),
    ],
    pops.map(({ time }, i) => ({ time: time - touch, text: `pop ${i + 1}`, colour: orange, dash: [3, 3] })),
  ];
  rows.forEach((marks, row) => {
    const labels = marks.map(({ time, text }, i) => ({
      x: Math.min(depth.x.px(time) - 2, depth.right + MARGIN.right - textWidth(text)),
      text,
      weight: i,
    }));
    const fits = labelsThatFit(labels, depth.left, depth.right + textWidth("◐ not judged") + MARGIN.right);
    marks.forEach(({ time, text, colour, ...look }, i) => {
      const x = depth.x.px(time);
      pen.segment(x, depth.top - 3, x, force.bottom, { colour, width: 1, ...look });
      if (fits[i]) pen.text(labels[i]!.x, 8 + 13 * row, text, { colour, bold: true });
    });
  });
}

/** The end of the drawing says what the verdict says. */
export function endWord({ passed, withheld, goals }: Pick<Result, "passed" | "withheld" | "goals">): string {
  if (passed) return "✓ done";
  if (withheld) return "◐ not judged";
  return goals.some(({ state }) => state === "missed") ? "✕ missed" : "ended";
}

function extreme(values: Float64Array, from: number, to: number, of: (a: number, b: number) => number): number {
  let found = 0;
  for (let i = from; i < to; i++) if (Number.isFinite(values[i])) found = of(found, values[i]!);
  return found;
}

function indexOfMost(values: Float64Array, from: number, to: number): number | null {
  let best: number | null = null;
  for (let i = from; i < to; i++)
    if (Number.isFinite(values[i]) && (best === null || values[i]! > values[best]!)) best = i;
  return best;
}

function wordsOf({ events }: Result): string {
  const pops = events
    .filter(({ what }) => what === "pop")
    .map(({ name, time }) => `through ${name} at ${time.toFixed(1)} s`);
  return `Depth of the tip and model force over time. ${pops.join(", ")}.`;
}
