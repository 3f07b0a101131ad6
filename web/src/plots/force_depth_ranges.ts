import { drawnMembranes, endOf, type ForceDepthPicture, meanBands, overlaidMembranes } from "./force_depth_picture.ts";
import { Extent, gatherOther, isCompared, type Ticks } from "./gather.ts";
import type { Pane } from "./kit/axes.ts";
import { AutoRange } from "./kit/scale.ts";

const MM = 1e3;
const OUTSIDE = 0.35; // length of the axis before the surface, as a share of its length behind it

/** The ranges of the axes. They include the laws, the drawn ticks and the compared run. */
export class ForceDepthRanges {
  private readonly rangeX = new AutoRange();
  private readonly rangeY = new AutoRange();
  private readonly x = new Extent();
  private readonly y = new Extent();
  private scratch = new Float32Array(0);

  /** Sets the axes of `pane` at the time `now`, s. */
  arrange(picture: ForceDepthPicture, pane: Pane, now: number): void {
    if (picture.zoom) {
      pane.rangeX(...picture.zoom.x);
      pane.rangeY(...picture.zoom.y);
      return;
    }
    this.measure(picture);
    // The path before the first surface is long and has no force.
    const before = Math.max(Math.min(this.x.low, 0), -OUTSIDE * this.x.high);
    this.rangeX.follow(before, this.x.high, now);
    this.rangeY.follow(this.y.low, this.y.high, now);
    pane.rangeX(this.rangeX.min, this.rangeX.max);
    pane.rangeY(this.rangeY.min, this.rangeY.max);
  }

  private measure(picture: ForceDepthPicture): void {
    const { x, y } = this;
    const { source, overlay, window, hidden } = picture;
    x.forget();
    y.forget();
    y.take(-0.1);
    y.take(0.1);
    x.take(2);
    const ticks = { history: source.history, first: window.first, end: endOf(picture) };
    const compared = hidden.shows("other") && isCompared(ticks);
    if (hidden.shows("permitted")) y.takeColumn(ticks, "ceiling", 0, 1);
    for (const i of drawnMembranes(picture)) {
      const law = source.laws.value[i];
      for (const force of law?.lower ?? []) y.take(-force);
      for (const force of law?.upper ?? []) y.take(-force);
      if (law) x.take(1.2 * law.through * MM);
      x.takeColumn(ticks, "depth", i, MM);
      y.takeColumn(ticks, "axial_force", i, -1);
      if (compared) this.takeOther(ticks, i);
    }
    for (const { band } of meanBands(picture)) {
      band.mean.forEach((mean, i) => {
        if (mean !== null) y.take(mean + (band.deviation[i] ?? 0));
      });
    }
    for (const i of overlaidMembranes(picture)) {
      const { history } = overlay!;
      y.takeColumn({ history, first: history.first, end: history.end }, "axial_force", i, -1);
    }
  }

  private takeOther(ticks: Ticks, membrane: number): void {
    const n = ticks.end - ticks.first;
    if (this.scratch.length < n) this.scratch = new Float32Array(2 * n);
    gatherOther(ticks, membrane, { gain: -1, bias: 0, out: this.scratch });
    this.y.takeNumbers(this.scratch, n);
  }
}
