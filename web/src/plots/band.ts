import type { LawCurve } from "../wire/messages.ts";
import type { Pane } from "./kit/axes.ts";
import type { Pen } from "./kit/pen.ts";
import { Polyline } from "./kit/polyline.ts";

const MM = 1e3;
const path = new Polyline();

/**
 * Draws a membrane's friction band, from Phi_I (upwards: felt during insertion) to Phi_O. The needle sticks at any
 * force inside the band.
 */
export function drawBand(pen: Pen, { x, y }: Pane, law: LawCurve, colour: string): void {
  const { depth, lower, upper } = law;
  if (!depth.length) return;
  // A law is constant beyond its last point.
  const onwards = x.px(Math.max(depth.at(-1)! * MM, x.max));
  path.clear();
  for (let i = 0; i < depth.length; i++) path.add(x.px(depth[i]! * MM), y.px(-lower[i]!));
  path.add(onwards, y.px(-lower.at(-1)!));
  path.add(onwards, y.px(-upper.at(-1)!));
  for (let i = depth.length - 1; i >= 0; i--) path.add(x.px(depth[i]! * MM), y.px(-upper[i]!));
  path.add(path.xs[0]!, path.ys[0]!);
  pen.area(path, colour, 0.13);
  pen.line(path, { colour, width: 1, alpha: 0.35 });
}
