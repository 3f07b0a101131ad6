import { drawBand } from "../../plots/band.ts";
import { drawAxes, MARGIN, Pane } from "../../plots/kit/axes.ts";
import type { Pen, Stroke } from "../../plots/kit/pen.ts";
import { Polyline } from "../../plots/kit/polyline.ts";
import { AutoRange } from "../../plots/kit/scale.ts";
import { colourOf, type Theme } from "../../plots/kit/theme.ts";
import type { LawCurve } from "../../wire/messages.ts";

const MM = 1e3;
const BEHIND = 1.25; // the depth axis is longer than the way through the membrane by this factor

/** Draws a law with the signs that the hand feels: resistance to insertion is above, resistance to withdrawal below. */
export class LawShape {
  readonly pane = new Pane();
  private readonly depth = new AutoRange();
  private readonly force = new AutoRange();
  private readonly path = new Polyline();

  /** Fits the axes to a law at the time `now`, s. A small change of the law moves the curve, not the axes. */
  fit(law: LawCurve, now: number): void {
    this.depth.follow(0, BEHIND * law.through * MM, now);
    this.force.follow(Math.min(-Math.max(...law.upper), 0), Math.max(-Math.min(...law.lower), 1e-3), now);
  }

  /** Draws another membrane: its axes have nothing to do with the last one's. */
  forget(): void {
    this.depth.forget();
    this.force.forget();
  }

  /** before: the law before the last change, drawn as a thin line behind. */
  draw(pen: Pen, law: LawCurve, before: LawCurve | null, width: number, height: number, theme: Theme): void {
    const { pane } = this;
    pane.place(MARGIN.left, MARGIN.top, width - MARGIN.left - MARGIN.right, height - MARGIN.top - MARGIN.bottom);
    pane.rangeX(0, this.depth.max);
    pane.rangeY(this.force.min, this.force.max);
    const [upper, lower] = [colourOf(theme, 0), colourOf(theme, 1)];
    drawAxes(pen, pane, theme, { x: "depth (mm)", y: "on the hand (N)" });
    pen.text(pane.right, pane.top - 9, "coming out", { colour: lower, bold: true, anchor: "end" });
    pen.text(pane.right - 76, pane.top - 9, "going in", { colour: upper, bold: true, anchor: "end" });
    pen.within(pane.left, pane.top, pane.width, pane.height, () => {
      drawBand(pen, pane, law, upper);
      const thin = { colour: theme.quiet, width: 1, dash: [3, 3] };
      if (before) for (const edge of [before.lower, before.upper]) this.line(pen, before.depth, edge, thin);
      this.line(pen, law.depth, law.upper, { colour: lower, width: 2 });
      this.line(pen, law.depth, law.lower, { colour: upper, width: 2 });
    });
  }

  private line(pen: Pen, depth: readonly number[], force: readonly number[], stroke: Stroke): void {
    const { x, y, right } = this.pane;
    this.path.clear();
    for (let i = 0; i < depth.length; i++) this.path.add(x.px(depth[i]! * MM), y.px(-force[i]!));
    if (depth.length) this.path.add(right, y.px(-force.at(-1)!)); // a law is constant beyond its last point
    pen.line(this.path, stroke);
  }
}
