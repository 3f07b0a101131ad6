import { drawMean, drawRow } from "../../plots/band_mean.ts";
import { drawAxes, MARGIN, Pane } from "../../plots/kit/axes.ts";
import type { Curve, Hidden } from "../../plots/kit/legend.ts";
import type { Pen } from "../../plots/kit/pen.ts";
import { niceStep } from "../../plots/kit/scale.ts";
import { colourOf, type Theme } from "../../plots/kit/theme.ts";
import type { LabBand, LabComparison } from "../../wire/messages.ts";
import { shortNames } from "./fields.ts";

export type On = "depth" | "time";
export type Quantity = "model" | "felt" | "force_limit" | "thumb" | "pressure" | "plunger";
const MM = 1e3;
const PALE = 8; // more runs than this are drawn paler, behind their mean

export const QUANTITIES: Readonly<Record<Quantity, string>> = {
  model: "model force",
  felt: "felt force",
  force_limit: "force limit",
  thumb: "thumb, model force",
  pressure: "pressure in the syringe",
  plunger: "plunger",
};
/** The unit of a quantity, and the factor to it from SI; newtons for the others. */
const UNITS: Readonly<Partial<Record<Quantity, readonly [string, number]>>> = {
  pressure: ["kPa", 1e-3],
  plunger: ["mm", MM],
};

/** The quantities that a run of the comparison has: those of the plunger only with a syringe. */
export const quantitiesOf = ({ depth }: Pick<LabComparison, "depth">): [Quantity, string][] =>
  (Object.entries(QUANTITIES) as [Quantity, string][]).filter(([name]) => depth.bands[name]);

export function labCurves(comparison: LabComparison, theme: Theme): Curve[] {
  const names = shortNames(comparison.statistics.map(({ name }) => name));
  const runs = names.map((text, i) => ({ id: `run ${i}`, text, colour: colourOf(theme, i) }));
  if (runs.length < 2) return runs;
  return [
    ...runs,
    { id: "mean", text: `mean ± standard deviation (n = ${runs.length})`, colour: theme.text, width: 4 },
  ];
}

/** Draws a force of all runs, and against time the depth below it. */
export function drawLab(
  pen: Pen,
  width: number,
  height: number,
  theme: Theme,
  comparison: LabComparison,
  on: On,
  quantity: Quantity,
  hidden: Hidden,
): void {
  const { bands } = comparison[on];
  const force = bands[quantity];
  const depth = on === "time" ? bands.depth : undefined;
  if (!force) return;
  const across = width - MARGIN.left - MARGIN.right;
  const room = height - MARGIN.top * (depth ? 2 : 1) - MARGIN.bottom;
  const above = new Pane();
  above.place(MARGIN.left, MARGIN.top, across, depth ? 0.6 * room : room);
  const x = { x: on === "time" ? "time since the first contact (s)" : "depth of the tip (mm)" };
  const [unit, gain] = UNITS[quantity] ?? ["N", 1];
  drawPane(pen, above, theme, force, on, gain, hidden, { y: `${QUANTITIES[quantity]} (${unit})`, ...(depth ? {} : x) });
  if (!depth) return;
  const below = new Pane();
  below.place(MARGIN.left, above.bottom + MARGIN.top, across, room - above.height);
  drawPane(pen, below, theme, depth, on, MM, hidden, { y: "depth of the tip (mm)", ...x });
}

function drawPane(
  pen: Pen,
  pane: Pane,
  theme: Theme,
  band: LabBand,
  on: On,
  gainY: number,
  hidden: Hidden,
  names: { readonly x?: string; readonly y: string },
): void {
  const gainX = on === "time" ? 1 : MM;
  const shade = band.mean.flatMap((mean, i) => [1, -1].map((side) => mean! + side * (band.deviation[i] ?? Number.NaN)));
  const values = [...band.runs.flat(), ...shade].filter((value): value is number => Number.isFinite(value));
  const [low, high] = [
    values.reduce((a, b) => Math.min(a, b), 0),
    values.reduce((a, b) => Math.max(a, b), 0.1 / gainY),
  ];
  const step = niceStep((high - low) * gainY, 5) / 2;
  pane.rangeX(0, Math.max(gainX * band.x.at(-1)!, 1e-6));
  pane.rangeY(Math.floor((low * gainY) / step) * step, Math.ceil((high * gainY * 1.02) / step) * step);
  drawAxes(pen, pane, theme, names);
  const many = band.runs.length > PALE;
  pen.within(pane.left, pane.top, pane.width, pane.height, () => {
    band.runs.forEach((row, i) => {
      const stroke = { colour: colourOf(theme, i), width: 1.4, alpha: many ? 0.5 : 1 };
      if (hidden.shows(`run ${i}`)) drawRow(pen, pane, band, row, [gainX, gainY, 0], stroke);
    });
    if (band.runs.length > 1 && hidden.shows("mean")) drawMean(pen, pane, band, [gainX, gainY, 0], theme.text);
  });
}
