import type { LabBand } from "../wire/messages.ts";
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

/** The stretches of x, [first, end), in which as many runs have a value, two or more: between them the mean jumps. */
export function stretches({ count }: LabBand): [number, number][] {
  const edges = [0, ...count.flatMap((n, i) => (i && n !== count[i - 1] ? [i] : [])), count.length];
  return edges.slice(1).flatMap((end, k): [number, number][] => (count[edges[k]!]! > 1 ? [[edges[k]!, end]] : []));
}

/**
 * Draws the mean of the runs, and one standard deviation on either side as a shade. The line breaks where a run ends.
 */
export function drawMean(
  pen: Pen,
  pane: Pane,
  band: LabBand,
  gains: readonly [number, number, number],
  colour: string,
): void {
  const [gainX, gainY, shift] = gains;
  const { x, y } = pane;
  const at = (i: number, deviations: number): void =>
    path.add(x.px(shift + gainX * band.x[i]!), y.px(gainY * (band.mean[i]! + deviations * band.deviation[i]!)));
  for (const [first, end] of stretches(band)) {
    path.clear();
    for (let i = first; i < end; i++) at(i, 1);
    for (let i = end - 1; i >= first; i--) at(i, -1);
    pen.area(path, colour, 0.18);
    path.clear();
    for (let i = first; i < end; i++) at(i, 0);
    pen.line(path, { colour, width: 2.5 });
  }
}
