import type { LabBand } from "../wire/files.ts";
import type { Pane } from "./kit/axes.ts";
import type { Pen, Stroke } from "./kit/pen.ts";
import { Polyline } from "./kit/polyline.ts";

const path = new Polyline();

/** Draws a row of a band as a line. gainX, gainY: from SI to the pane's units; shift: of x, in the pane's units. */
export function drawRow(
  pen: Pen,
  { x, y }: Pane,
  band: LabBand,
  row: readonly (number | null)[],
  [gainX, gainY, shift]: readonly [number, number, number],
  stroke: Stroke,
): void {
  path.clear();
  row.forEach((value, i) => {
    if (value === null) path.gap();
    else path.add(x.px(shift + gainX * band.x[i]!), y.px(gainY * value));
  });
  if (path.count) pen.line(path, stroke);
}

/** Draws the mean of all runs, and one standard deviation on either side as a shade. */
export function drawMean(
  pen: Pen,
  pane: Pane,
  band: LabBand,
  gains: readonly [number, number, number],
  colour: string,
): void {
  const [gainX, gainY, shift] = gains;
  const { x, y } = pane;
  const known = band.x.map((_, i) => i).filter((i) => band.mean[i] !== null && band.deviation[i] !== null);
  const at = (i: number, side: 1 | -1): void =>
    path.add(x.px(shift + gainX * band.x[i]!), y.px(gainY * (band.mean[i]! + side * band.deviation[i]!)));
  path.clear();
  for (const i of known) at(i, 1);
  for (const i of known.toReversed()) at(i, -1);
  if (path.count) pen.area(path, colour, 0.18);
  drawRow(pen, pane, band, band.mean, gains, { colour, width: 2.5 });
}
