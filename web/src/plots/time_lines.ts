import { DASH, shownMembranes } from "./curves.ts";
import { type Extent, gather, gatherOther, gatherSize, gatherTime, isCompared } from "./gather.ts";
import type { Pane } from "./kit/axes.ts";
import { decimate } from "./kit/decimate.ts";
import type { Pen, Stroke } from "./kit/pen.ts";
import { Polyline } from "./kit/polyline.ts";
import { colourOf, type Theme } from "./kit/theme.ts";
import { hasThumb, MM, THUMB_DASH, type TimePicture, WIDE } from "./time_picture.ts";

const SIZES = [["model", "model_force"], ["felt", "force"]] as const; // biome-ignore format: a table

/** The curves against time, and their extents. Reuses its buffers from picture to picture. */
export class TimeLines {
  private readonly path = new Polyline();
  private xs = new Float32Array(0);
  private ys = new Float32Array(0);

  constructor(
    private readonly force: Pane,
    private readonly depth: Pane,
  ) {}

  /** Takes the values of all shown curves from the tick `first` up to but not including `end`: N, and mm. */
  measure({ source, hidden }: TimePicture, first: number, end: number, force: Extent, depth: Extent): void {
    const ticks = { history: source.history, first, end };
    this.room(end - first);
    for (const i of shownMembranes(source.history, hidden)) {
      force.takeColumn(ticks, "axial_force", i, -1);
      depth.takeColumn(ticks, "depth", i, MM);
    }
    for (const [id, column] of SIZES) {
      if (!hidden.shows(id)) continue;
      gatherSize(ticks, column, { gain: 1, bias: 0, out: this.ys });
      force.takeNumbers(this.ys, end - first);
    }
    if (hidden.shows("permitted")) force.takeColumn(ticks, "ceiling", 0, 1);
    if (hasThumb(source) && hidden.shows("thumb")) force.takeColumn(ticks, "thumb_force", 0, -1);
  }

  /** Draws the curves from the tick `first` up to but not including `end`. */
  draw(pen: Pen, picture: TimePicture, first: number, end: number, theme: Theme): void {
    const n = end - first;
    if (n < 2) return;
    this.room(n);
    const { force, depth } = this;
    const { history } = picture.source;
    const ticks = { history, first, end };
    const { slope } = force.x;
    gatherTime(ticks, { gain: slope, bias: force.x.from - slope * force.x.min, out: this.xs });
    pen.within(force.left, force.top, force.width, force.height, () =>
      this.drawForces(pen, picture, first, end, theme),
    );
    pen.within(depth.left, depth.top, depth.width, depth.height, () => {
      for (const i of shownMembranes(history, picture.hidden)) {
        gather(ticks, "depth", i, { gain: MM * depth.y.slope, bias: depth.y.px(0), out: this.ys });
        this.drawLine(pen, n, { colour: colourOf(theme, i), width: 1.5 });
      }
    });
  }

  private drawForces(pen: Pen, { source, hidden }: TimePicture, first: number, end: number, theme: Theme): void {
    const { history } = source;
    const ticks = { history, first, end };
    const { x, y } = this.force;
    const gain = y.slope;
    const zero = y.px(0);
    const n = end - first;
    const phase = x.slope * x.min - x.from;
    const looks = {
      model: { colour: theme.text, width: WIDE, alpha: 0.25 },
      felt: { colour: theme.text, width: 1.25 },
    };
    for (const [id, column] of SIZES) {
      if (!hidden.shows(id)) continue;
      gatherSize(ticks, column, { gain, bias: zero, out: this.ys });
      this.drawLine(pen, n, looks[id]);
    }
    if (hasThumb(source) && hidden.shows("thumb")) {
      gather(ticks, "thumb_force", 0, { gain: -gain, bias: zero, out: this.ys });
      this.drawLine(pen, n, { colour: theme.accent, width: 1.5, dash: THUMB_DASH, phase });
    }
    if (hidden.shows("permitted")) {
      gather(ticks, "ceiling", 0, { gain, bias: zero, out: this.ys });
      this.drawLine(pen, n, { colour: theme.danger, width: 1.25, dash: DASH, phase });
    }
    const compared = hidden.shows("other") && isCompared(ticks);
    for (const i of shownMembranes(history, hidden)) {
      if (compared) {
        gatherOther(ticks, i, { gain: -gain, bias: zero, out: this.ys });
        this.drawLine(pen, n, { colour: theme.quiet, width: 1 });
      }
      gather(ticks, "axial_force", i, { gain: -gain, bias: zero, out: this.ys });
      this.drawLine(pen, n, { colour: colourOf(theme, i), width: 1.5 });
    }
  }

  private drawLine(pen: Pen, n: number, stroke: Stroke): void {
    this.path.clear();
    decimate(this.xs, this.ys, 0, n, this.path);
    if (this.path.count) pen.line(this.path, stroke);
  }

  private room(n: number): void {
    if (this.xs.length >= n) return;
    this.xs = new Float32Array(2 * n);
    this.ys = new Float32Array(2 * n);
  }
}
