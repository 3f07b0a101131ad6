import type { Source } from "../state/source.ts";
import { drawBand } from "./band.ts";
import { drawMean } from "./band_mean.ts";
import { DASH, forceCurves, meanCurve, membraneCurves } from "./curves.ts";
import {
  bandedMembranes,
  drawnMembranes,
  endOf,
  type ForceDepthPicture,
  meanBands,
  overlaidMembranes,
} from "./force_depth_picture.ts";
import { ForceDepthRanges } from "./force_depth_ranges.ts";
import { gather, gatherFelt, gatherOther, gatherPermitted, isCompared } from "./gather.ts";
import { drawAxes, MARGIN, Pane } from "./kit/axes.ts";
import { decimate } from "./kit/decimate.ts";
import type { Curve } from "./kit/legend.ts";
import { Painted } from "./kit/painted.ts";
import type { Pen, Stroke } from "./kit/pen.ts";
import { Polyline } from "./kit/polyline.ts";
import { colourOf, type Theme } from "./kit/theme.ts";
import { drawEnds, endAt } from "./names.ts";
import { drawPops } from "./pop_marks.ts";

const MM = 1e3;
const AGES = 8; // the history fades in this many steps
const WIDTH = 1.6; // px

/** The curves that the plot can show, for its legend. */
export function forceDepthCurves(picture: ForceDepthPicture, theme: Theme): Curve[] {
  const { source, window, overlay, chosen } = picture;
  const membranes = membraneCurves(source, theme);
  return [
    ...(chosen === null ? membranes : membranes.slice(chosen, chosen + 1)),
    ...forceCurves(source, window.first, endOf(picture), theme),
    { id: "band", text: "friction band", colour: theme.quiet, shade: 0.25 },
    ...meanCurve(picture.comparison, theme),
    ...(overlay ? [{ id: "earlier", text: overlay.title, colour: theme.text, dash: DASH }] : []),
  ];
}

/** Draws force against depth. Reuses its buffers from frame to frame. */
export class ForceDepthDrawing {
  readonly pane = new Pane();
  private readonly ranges = new ForceDepthRanges();
  private readonly path = new Polyline();
  private readonly fresh = new Polyline();
  private readonly painted = new Painted();
  private xs = new Float32Array(0);
  private ys = new Float32Array(0);

  /** Computes the axes for `picture` at the time `now`, s. */
  arrange(picture: ForceDepthPicture, width: number, height: number, now: number): void {
    const { left, right, top, bottom } = MARGIN;
    this.pane.place(left, top, width - left - right, height - top - bottom);
    this.ranges.arrange(picture, this.pane, now);
  }

  /** Draws the whole plot. */
  draw(pen: Pen, picture: ForceDepthPicture, theme: Theme): void {
    this.drawBack(pen, picture, theme);
    this.drawFront(pen, picture, endOf(picture), theme);
  }

  /** Draws the background: bands, axes and the ticks up to now. */
  drawBack(pen: Pen, picture: ForceDepthPicture, theme: Theme): void {
    const { left, top, width, height } = this.pane;
    const { source, window, overlay, hidden } = picture;
    const end = endOf(picture);
    const membranes = drawnMembranes(picture);
    pen.within(left, top, width, height, () => {
      for (const i of hidden.shows("band") ? bandedMembranes(picture) : []) {
        const law = source.laws.value[i];
        if (law) drawBand(pen, this.pane, law, colourOf(theme, i));
      }
    });
    drawAxes(pen, this.pane, theme, { x: "depth along the needle (mm)", y: "force (N)" });
    pen.within(left, top, width, height, () => {
      for (const i of hidden.shows("earlier") ? overlaidMembranes(picture) : [])
        this.drawOverlay(pen, overlay!, i, theme);
      for (const { membrane, band } of meanBands(picture))
        drawMean(pen, this.pane, band, [MM, 1, 0], colourOf(theme, membrane));
      this.drawMore(pen, picture, window.first, end, theme);
      for (const i of membranes) this.drawHistory(pen, picture, i, theme);
    });
    drawPops(pen, this.pane, picture, theme);
  }

  /** Draws the foreground: the new ticks, from the tick `from` on, the present tick and the pointed tick. */
  drawFront(pen: Pen, picture: ForceDepthPicture, from: number, theme: Theme): void {
    const { left, top, width, height } = this.pane;
    const { source, window } = picture;
    const first = Math.max(window.first, from - 1);
    const end = endOf(picture);
    pen.within(left, top, width, height, () => {
      if (end - first > 1) this.drawMore(pen, picture, first, end, theme);
      for (const i of end - first > 1 ? drawnMembranes(picture) : []) {
        const n = this.pixels(source, first, end, i);
        this.path.clear();
        decimate(this.xs, this.ys, 0, n, this.path);
        pen.line(this.path, { colour: colourOf(theme, i), width: WIDTH });
      }
      this.drawPresent(pen, picture, theme);
    });
  }

  /** The drawn tick nearest to the point (x, y), px; null if none lies within `radius` px. */
  nearest(picture: ForceDepthPicture, x: number, y: number, radius: number): { tick: number; membrane: number } | null {
    let least = radius * radius;
    let found: { tick: number; membrane: number } | null = null;
    const { first } = picture.window;
    for (const m of drawnMembranes(picture)) {
      const n = this.pixels(picture.source, first, endOf(picture), m);
      let best = -1;
      for (let i = 0; i < n; i++) {
        const dx = this.xs[i]! - x;
        const dy = this.ys[i]! - y;
        const square = dx * dx + dy * dy;
        if (square <= least) {
          least = square;
          best = i;
        }
      }
      if (best >= 0) found = { tick: first + best, membrane: m };
    }
    return found;
  }

  /** Writes the ticks of a membrane as pixels to xs and ys; returns their number. */
  private pixels(source: Source, first: number, end: number, membrane: number): number {
    const n = Math.max(0, end - first);
    if (this.xs.length < n) {
      this.xs = new Float32Array(2 * n);
      this.ys = new Float32Array(2 * n);
    }
    const { x, y } = this.pane;
    const ticks = { history: source.history, first, end };
    gather(ticks, "depth", membrane, { gain: MM * x.slope, bias: x.px(0), out: this.xs });
    gather(ticks, "axial_force", membrane, { gain: -y.slope, bias: y.px(0), out: this.ys });
    return n;
  }

  private drawOverlay(pen: Pen, overlay: Source, membrane: number, theme: Theme): void {
    const { first, end } = overlay.history;
    const n = this.pixels(overlay, first, end, membrane);
    this.drawNew(pen, 0, n, { colour: theme.text, width: 1.5, dash: DASH }, true);
  }

  /** Draws the needle's path. Older parts are fainter. */
  private drawHistory(pen: Pen, picture: ForceDepthPicture, membrane: number, theme: Theme): void {
    const { source, window, oldest } = picture;
    const end = endOf(picture);
    const n = this.pixels(source, window.first, end, membrane);
    const colour = colourOf(theme, membrane);
    const age = Math.max(1, Math.ceil((window.end - window.first) / AGES));
    // Newest first: older pieces under it are then skipped.
    for (let to = n, young = 1; to > 0; to -= age, young -= 1 / AGES) {
      const stroke = { colour, width: WIDTH, alpha: oldest + (1 - oldest) * Math.max(0, young) ** 2 };
      this.drawNew(pen, Math.max(0, to - age - 1), to, stroke, to === n);
    }
  }

  /** Draws the felt force, the force limit and the other solver's force, where they are switched on. */
  private drawMore(pen: Pen, picture: ForceDepthPicture, first: number, end: number, theme: Theme): void {
    const { source, hidden } = picture;
    const ticks = { history: source.history, first, end };
    const { y } = this.pane;
    const other = hidden.shows("other") && isCompared(ticks);
    for (const i of drawnMembranes(picture)) {
      const n = this.pixels(source, first, end, i);
      if (hidden.shows("permitted")) {
        gatherPermitted(ticks, i, { gain: y.slope, bias: y.px(0), out: this.ys });
        this.drawNew(pen, 0, n, { colour: theme.danger, width: 1.25, dash: DASH }, true);
      }
      if (hidden.shows("felt")) {
        gatherFelt(ticks, i, { gain: -y.slope, bias: y.px(0), out: this.ys });
        this.drawNew(pen, 0, n, { colour: theme.text, width: 1.25, alpha: 0.7 }, true);
      }
      if (other) {
        gatherOther(ticks, i, { gain: -y.slope, bias: y.px(0), out: this.ys });
        this.drawNew(pen, 0, n, { colour: theme.quiet, width: 1 }, true);
      }
    }
  }

  /** Draws the gathered pixels that are not painted yet; `clear` marks all pixels as not painted first. */
  private drawNew(pen: Pen, from: number, to: number, stroke: Stroke, clear: boolean): void {
    const { left, top, width, height } = this.pane;
    if (clear) this.painted.begin(left, top, width, height);
    this.path.clear();
    this.fresh.clear();
    decimate(this.xs, this.ys, from, to, this.path);
    this.painted.addNew(this.path, this.fresh);
    if (this.fresh.count) pen.line(this.fresh, stroke);
  }

  private drawPresent(pen: Pen, picture: ForceDepthPicture, theme: Theme): void {
    const { history } = picture.source;
    const { x, y } = this.pane;
    const last = endOf(picture) - 1;
    const place = (tick: number, membrane: number): [number, number] => [
      x.px(history.row("depth", tick)[membrane]! * MM),
      y.px(-history.row("axial_force", tick)[membrane]!),
    ];
    if (picture.pointed) {
      const [px, py] = place(picture.pointed.tick, picture.pointed.membrane);
      const hair = { colour: theme.text, width: 1, alpha: 0.5, dash: [3, 3] };
      pen.segment(px, this.pane.top, px, this.pane.bottom, hair);
      pen.segment(this.pane.left, py, this.pane.right, py, hair);
      pen.dot(px, py, 4, theme.panel, theme.text);
    }
    if (last < history.first || last >= history.end) return;
    const ends = drawnMembranes(picture).map((i) => endAt(picture.source, i, ...place(last, i), theme));
    drawEnds(pen, this.pane, ends, theme);
  }
}
