import { MODEL_FORCE } from "../state/scale.ts";
import type { Source } from "../state/source.ts";
import type { LabComparison } from "../wire/files.ts";
import { drawBadge } from "./badge.ts";
import { drawMean } from "./band_mean.ts";
import { DASH, forceCurves, meanCurve, membraneCurves, shownMembranes } from "./curves.ts";
import { Extent, gather, gatherOther, gatherSize, gatherTime, isCompared } from "./gather.ts";
import { AutoRange } from "./kit/auto_range.ts";
import { drawAxes, MARGIN, Pane } from "./kit/axes.ts";
import { decimate } from "./kit/decimate.ts";
import type { Curve, Hidden } from "./kit/legend.ts";
import type { Pen, Stroke } from "./kit/pen.ts";
import { Polyline } from "./kit/polyline.ts";
import { colourOf, type Theme } from "./kit/theme.ts";
import { drawReading } from "./reading.ts";
import { drawFound, drawLimits, drawMarks, drawStates, foundCurve, limitCurve } from "./time_marks.ts";
import type { Window } from "./window.ts";

const MM = 1e3;
const FORCE_SHARE = 0.58;
const THUMB_DASH = [8, 3] as const;
const WIDE = 5; // px: the model's force stays visible behind an equal felt force
const SIZES = [["model", "model_force"], ["felt", "force"]] as const; // biome-ignore format: a table

/** The window of ticks to draw. Depths in mm; forces in N, positive if they push the needle out. */
export interface TimePicture {
  readonly source: Source;
  readonly window: Window;
  readonly pointed: number | null;
  /** The tick at which the timeline stands. */
  readonly cursor: number | null;
  readonly hidden: Hidden;
  /** Whether the table at the pointed tick leaves the depth out. */
  readonly noDepth: boolean;
  readonly comparison: LabComparison | null;
}

const hasThumb = (source: Source): boolean => Boolean(source.scene.value?.syringe);
const thumbCurve = (source: Source, theme: Theme): Curve[] =>
  hasThumb(source) ? [{ id: "thumb", text: `thumb, ${MODEL_FORCE}`, colour: theme.accent, dash: THUMB_DASH }] : [];

/** The curves that the plot can show, for its legend. */
export const timeCurves = ({ source, window, comparison }: TimePicture, theme: Theme): Curve[] => [
  ...membraneCurves(source, theme),
  { id: "model", text: "model force", colour: theme.quiet, width: WIDE },
  ...forceCurves(source, window.first, window.end, theme),
  ...thumbCurve(source, theme),
  ...limitCurve(source.history, window, theme),
  ...foundCurve(source, window, theme),
  ...meanCurve(comparison, theme),
];

/** Draws force and depth against one time axis. Reuses its buffers from frame to frame. */
export class TimeDrawing {
  readonly force = new Pane();
  readonly depth = new Pane();
  private readonly rangeForce = new AutoRange();
  private readonly rangeDepth = new AutoRange();
  private readonly extent = new Extent();
  private readonly path = new Polyline();
  private xs = new Float32Array(0);
  private ys = new Float32Array(0);

  /** Resets the value ranges, for another part of the run. */
  forget(): void {
    this.rangeForce.forget();
    this.rangeDepth.forget();
  }

  /** Computes the axes at the time `now`, s. */
  arrange({ source, window, hidden }: TimePicture, width: number, height: number, now: number): void {
    const { force, depth, extent } = this;
    const across = width - MARGIN.left - MARGIN.right;
    const room = height - 2 * MARGIN.top - MARGIN.bottom;
    const upper = Math.round(FORCE_SHARE * room);
    force.place(MARGIN.left, MARGIN.top, across, upper);
    depth.place(MARGIN.left, 2 * MARGIN.top + upper, across, room - upper);
    const { history } = source;
    extent.forget();
    extent.take(-0.1);
    extent.take(0.1);
    const shown = shownMembranes(history, hidden);
    for (const i of shown) extent.takeColumn(history, window.first, window.end, "axial_force", i, -1);
    this.room(window.end - window.first);
    for (const [id, column] of SIZES) {
      if (!hidden.shows(id)) continue;
      gatherSize(history, window.first, window.end, column, 1, 0, this.ys);
      extent.takeNumbers(this.ys, window.end - window.first);
    }
    if (hidden.shows("permitted")) extent.takeColumn(history, window.first, window.end, "ceiling", 0, 1);
    if (hasThumb(source) && hidden.shows("thumb"))
      extent.takeColumn(history, window.first, window.end, "thumb_force", 0, -1);
    this.rangeForce.follow(extent.low, extent.high, now);
    extent.forget();
    extent.take(-1);
    extent.take(1);
    for (const i of shown) extent.takeColumn(history, window.first, window.end, "depth", i, MM);
    // While the hand is far from the tissue, the range must not flatten the curve inside it.
    this.rangeDepth.follow(Math.max(extent.low, -Math.max(10, 1.5 * extent.high)), extent.high, now);
    for (const pane of [force, depth]) pane.rangeX(window.from, window.to);
    force.rangeY(this.rangeForce.min, this.rangeForce.max);
    depth.rangeY(this.rangeDepth.min, this.rangeDepth.max);
  }

  /** Draws the whole plot. */
  draw(pen: Pen, picture: TimePicture, theme: Theme): void {
    this.drawBack(pen, picture, theme);
    this.drawFront(pen, picture, picture.window.end, theme);
  }

  /** Draws the background, which stays the same while the window stays. */
  drawBack(pen: Pen, picture: TimePicture, theme: Theme): void {
    const { source, window, hidden } = picture;
    drawStates(pen, this.force, this.depth, source.history, window, theme);
    if (hidden.shows("cut")) drawLimits(pen, this.force, source.history, window, theme);
    drawAxes(pen, this.force, theme, { y: "force (N)" });
    drawAxes(pen, this.depth, theme, { x: "time (s)", y: "depth (mm)" });
    drawMarks(pen, this.force, this.depth, source, window, theme);
    if (hidden.shows("found")) drawFound(pen, this.force, this.depth, source, window, theme);
    this.drawMeans(pen, picture, theme);
    this.drawLines(pen, picture, window.first, window.end, theme);
  }

  /** Draws the foreground: the new ticks, from the tick `from` on, the present tick and the pointed tick. */
  drawFront(pen: Pen, picture: TimePicture, from: number, theme: Theme): void {
    const { window } = picture;
    this.drawLines(pen, picture, Math.max(window.first, from - 1), window.end, theme);
    this.drawNow(pen, picture, theme);
  }

  private drawLines(pen: Pen, picture: TimePicture, first: number, end: number, theme: Theme): void {
    const n = end - first;
    if (n < 2) return;
    this.room(n);
    const { force, depth } = this;
    const { history } = picture.source;
    const { slope } = force.x;
    gatherTime(history, first, end, slope, force.x.from - slope * force.x.min, this.xs);
    pen.within(force.left, force.top, force.width, force.height, () =>
      this.drawForces(pen, picture, first, end, theme),
    );
    pen.within(depth.left, depth.top, depth.width, depth.height, () => {
      for (const i of shownMembranes(history, picture.hidden)) {
        gather(history, first, end, "depth", i, MM * depth.y.slope, depth.y.px(0), this.ys);
        this.drawLine(pen, n, { colour: colourOf(theme, i), width: 1.5 });
      }
    });
  }

  /** Draws the mean of the compared runs from the last first contact on that the window shows. */
  private drawMeans(pen: Pen, { source, window, comparison, hidden }: TimePicture, theme: Theme): void {
    const touch = source.events.value.findLast(
      ({ what, membrane, tick }) => what === "touch" && membrane === 0 && tick >= window.first && tick < window.end,
    );
    if (!comparison || !touch || !hidden.shows("mean")) return;
    const { model, depth } = comparison.time.bands;
    const start = source.history.timeOf(touch.tick);
    const means = [[this.force, model, 1], [this.depth, depth, MM]] as const; // biome-ignore format: a table
    for (const [pane, band, gain] of means)
      pen.within(pane.left, pane.top, pane.width, pane.height, () => {
        if (band) drawMean(pen, pane, band, [1, gain, start], theme.quiet);
      });
  }

  private room(n: number): void {
    if (this.xs.length >= n) return;
    this.xs = new Float32Array(2 * n);
    this.ys = new Float32Array(2 * n);
  }

  private drawForces(pen: Pen, { source, hidden }: TimePicture, first: number, end: number, theme: Theme): void {
    const { history } = source;
    const { y } = this.force;
    const gain = y.slope;
    const zero = y.px(0);
    const n = end - first;
    const looks = {
      model: { colour: theme.text, width: WIDE, alpha: 0.25 },
      felt: { colour: theme.text, width: 1.25 },
    };
    for (const [id, column] of SIZES) {
      if (!hidden.shows(id)) continue;
      gatherSize(history, first, end, column, gain, zero, this.ys);
      this.drawLine(pen, n, looks[id]);
    }
    if (hasThumb(source) && hidden.shows("thumb")) {
      gather(history, first, end, "thumb_force", 0, -gain, zero, this.ys);
      this.drawLine(pen, n, { colour: theme.accent, width: 1.5, dash: THUMB_DASH });
    }
    if (hidden.shows("permitted")) {
      gather(history, first, end, "ceiling", 0, gain, zero, this.ys);
      this.drawLine(pen, n, { colour: theme.danger, width: 1.25, dash: DASH });
    }
    const compared = hidden.shows("other") && isCompared(history, first, end);
    for (const i of shownMembranes(history, hidden)) {
      if (compared) {
        gatherOther(history, first, end, i, -gain, zero, this.ys);
        this.drawLine(pen, n, { colour: theme.quiet, width: 1 });
      }
      gather(history, first, end, "axial_force", i, -gain, zero, this.ys);
      this.drawLine(pen, n, { colour: colourOf(theme, i), width: 1.5 });
    }
  }

  private drawLine(pen: Pen, n: number, stroke: Stroke): void {
    this.path.clear();
    decimate(this.xs, this.ys, 0, n, this.path);
    if (this.path.count) pen.line(this.path, stroke);
  }

  private drawNow(pen: Pen, picture: TimePicture, theme: Theme): void {
    const { source, window, pointed, cursor, hidden, noDepth } = picture;
    const { history } = source;
    const { force, depth } = this;
    const { bottom } = depth;
    const shown = shownMembranes(history, hidden);
    const inside = (tick: number | null): tick is number =>
      tick !== null &&
      tick >= window.first &&
      tick < window.end &&
      force.holds(force.x.px(history.timeOf(tick)), force.top);
    if (inside(cursor)) {
      const x = force.x.px(history.timeOf(cursor));
      pen.segment(x, force.top, x, bottom, { colour: theme.accent, width: 1.5 });
    }
    const last = window.end - 1;
    if (inside(last)) {
      const x = force.x.px(history.timeOf(last));
      for (const i of shown.toReversed()) {
        const y = depth.y.px(history.row("depth", last)[i]! * MM);
        if (depth.holds(x, y)) drawBadge(pen, Math.min(x, depth.right - 8), y, i, theme);
      }
    }
    if (inside(pointed)) {
      const x = force.x.px(history.timeOf(pointed));
      pen.segment(x, force.top, x, bottom, { colour: theme.text, width: 1, alpha: 0.6, dash: [3, 3] });
      for (const i of shown) {
        const places = [
          [force, -history.row("axial_force", pointed)[i]!],
          [depth, history.row("depth", pointed)[i]! * MM],
        ] as const;
        for (const [pane, value] of places) {
          const y = pane.y.px(value);
          if (pane.holds(x, y)) pen.dot(x, y, 3, theme.panel, colourOf(theme, i));
        }
      }
      drawReading(pen, force, source, pointed, theme, noDepth);
    }
  }
}
