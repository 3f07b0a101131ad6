import { drawAxes, MARGIN, Pane } from "../../../plots/kit/axes.ts";
import { decimate } from "../../../plots/kit/decimate.ts";
import { labelsThatFit } from "../../../plots/kit/labels.ts";
import type { Curve, Hidden } from "../../../plots/kit/legend.ts";
import type { Pen, Stroke } from "../../../plots/kit/pen.ts";
import { Polyline } from "../../../plots/kit/polyline.ts";
import { niceStep } from "../../../plots/kit/scale.ts";
import { colourOf, type Theme } from "../../../plots/kit/theme.ts";
import type { CurvesPart, TraceLine } from "../../../wire/messages.ts";

export type Against = "depth" | "time";
const MM = 1e3;
const ROW = 14; // px, for the labels above the plot

/** Another model, drawn beside the fit. */
export interface Other {
  readonly title: string;
  readonly force: readonly number[];
}

/** What is drawn. */
export interface Shown {
  readonly trace: Pick<TraceLine, "contact" | "pops">;
  readonly curves: CurvesPart;
  readonly other: Other | null;
  readonly against: Against;
}

const strokes = (theme: Theme): Readonly<Record<"measured" | "model" | "other" | "residual", Stroke>> => ({
  measured: { colour: colourOf(theme, 0), width: 1.4, alpha: 0.8 },
  model: { colour: colourOf(theme, 1), width: 2 },
  other: { colour: colourOf(theme, 3), width: 1.6, dash: [6, 4] },
  residual: { colour: colourOf(theme, 2), width: 1.2 },
});

export function traceCurves({ curves, other }: Pick<Shown, "curves" | "other">, theme: Theme): Curve[] {
  const { measured, model, other: beside, residual } = strokes(theme);
  const trace = { id: "measured", text: "measured", colour: measured.colour, width: measured.width };
  if (!curves.model) return [trace];
  return [
    trace,
    { id: "model", text: "model", colour: model.colour, width: model.width },
    ...(other ? [{ id: "other", text: other.title, ...beside }] : []),
    { id: "residual", text: "model − measured", colour: residual.colour, width: residual.width },
  ];
}

/** Draws a trace, its fit, and below them what is left between the two. */
export function drawTrace(
  pen: Pen,
  width: number,
  height: number,
  theme: Theme,
  { trace, curves, other, against }: Shown,
  hidden: Hidden,
): void {
  const { model } = curves;
  const onTime = against === "time" && curves.time !== null;
  const xs = onTime ? curves.time! : curves.depth.map((depth) => MM * depth);
  const left = model && curves.force.map((force, i) => model[i]! - force);
  const [force, residual] = [new Pane(), new Pane()];
  const across = width - MARGIN.left - MARGIN.right;
  const room = height - ROW - MARGIN.top * (left ? 2 : 1) - MARGIN.bottom;
  force.place(MARGIN.left, ROW + MARGIN.top, across, left ? 0.72 * room : room);
  residual.place(MARGIN.left, force.bottom + MARGIN.top, across, Math.max(room - force.height, 1));
  const [from, to] = extent(xs);
  const name = { x: onTime ? "time (s)" : "depth of the needle (mm)" };
  for (const pane of [force, residual]) pane.rangeX(from, Math.max(to, from + 1e-6));
  fit(force, [curves.force, ...(model ? [model] : []), ...(other ? [other.force] : [])]);
  drawAxes(pen, force, theme, { y: "force that resists (N)", ...(left ? {} : name) });
  if (!onTime) drawPops(pen, force, left ? residual.bottom : force.bottom, trace, theme);
  const { measured, model: fitted, other: beside, residual: rest } = strokes(theme);
  const line = (pane: Pane, values: readonly number[], stroke: Stroke): void => {
    const path = new Polyline();
    const [px, py] = [Float32Array.from(xs, (x) => pane.x.px(x)), Float32Array.from(values, (y) => pane.y.px(y))];
    decimate(px, py, 0, px.length, path);
    pen.within(pane.left, pane.top, pane.width, pane.height, () => pen.line(path, stroke));
  };
  if (hidden.shows("measured")) line(force, curves.force, measured);
  if (!model || !left) return;
  if (other && hidden.shows("other")) line(force, other.force, beside);
  if (hidden.shows("model")) line(force, model, fitted);
  fit(residual, [left]);
  drawAxes(pen, residual, theme, { y: "model − measured (N)", ...name });
  if (hidden.shows("residual")) line(residual, left, rest);
}

function fit(pane: Pane, rows: readonly (readonly number[])[]): void {
  const all = rows.map(extent);
  const low = Math.min(0, ...all.map(([least]) => least));
  const high = Math.max(low + 1e-6, ...all.map(([, most]) => most));
  const step = niceStep(high - low, 5) / 2;
  pane.rangeY(Math.floor(low / step) * step, Math.ceil((high * 1.02) / step) * step);
}

function extent(values: readonly number[]): [number, number] {
  return values.reduce<[number, number]>(([a, b], x) => [Math.min(a, x), Math.max(b, x)], [Infinity, -Infinity]);
}

/** Lines at the contact and at each pop. */
function drawPops(
  pen: Pen,
  pane: Pane,
  bottom: number,
  trace: Pick<TraceLine, "contact" | "pops">,
  theme: Theme,
): void {
  const marks = [
    ...(trace.contact === null ? [] : [{ depth: trace.contact, text: "contact" }]),
    ...trace.pops.map((depth, i) => ({ depth, text: trace.pops.length > 1 ? `pop ${i + 1}` : "pop" })),
  ].map((mark) => ({ ...mark, x: pane.x.px(MM * mark.depth) }));
  const fits = labelsThatFit(
    marks.map(({ x, text }, i) => ({ x, text, weight: i })),
    0,
    pane.right + MARGIN.right,
  );
  marks.forEach(({ x, text }, i) => {
    pen.segment(x, pane.top - 4, x, bottom, { colour: theme.quiet, width: 1, dash: [3, 3] });
    if (fits[i]) pen.text(x, 8, text, { colour: theme.quiet });
  });
}
