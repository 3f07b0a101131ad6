import { tickAt } from "../state/history.ts";
import { feltForce, MODEL_FORCE, scaleOf } from "../state/scale.ts";
import type { Source } from "../state/source.ts";
import { drawMean } from "./band_mean.ts";
import { forceCurves, meanCurve, membraneCurves, shownMembranes } from "./curves.ts";
import { Extent, signedSize } from "./gather.ts";
import { drawAxes, MARGIN, Pane } from "./kit/axes.ts";
import type { Curve } from "./kit/legend.ts";
import type { Pen } from "./kit/pen.ts";
import { AutoRange } from "./kit/scale.ts";
import { colourOf, type Theme } from "./kit/theme.ts";
import { drawEnds, type End, endAt } from "./names.ts";
import { drawReading } from "./reading.ts";
import { TimeLines } from "./time_lines.ts";
import { drawFound, drawLimits, drawMarks, drawStates, foundCurve, limitCurve } from "./time_marks.ts";
import { hasThumb, MM, THUMB_DASH, type TimePicture, WIDE } from "./time_picture.ts";

const FORCE_SHARE = 0.58;
const SCAN_S = 0.5; // while ticks are added, the ranges see at least so often that old ones have left the window
const EDGE = 4; // px: half the widest line, and the soft edge of a thinner one

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
  private readonly lines = new TimeLines(this.force, this.depth);
  private readonly rangeForce = new AutoRange();
  private readonly rangeDepth = new AutoRange();
  private readonly forces = new Extent();
  private readonly depths = new Extent();
  private scanned = Number.NEGATIVE_INFINITY; // time of the last look at all ticks of the window, s

  /** Resets the value ranges, for another part of the run. */
  forget(): void {
    this.rangeForce.forget();
    this.rangeDepth.forget();
  }

  /**
   * Computes the axes at the time `now`, s. from: the first tick that has come since the last call, if the window has
   * only moved on. Returns whether the range of an axis of values has changed.
   */
  arrange(picture: TimePicture, width: number, height: number, now: number, from: number | null = null): boolean {
    const { force, depth } = this;
    const across = width - MARGIN.left - MARGIN.right;
    const room = height - 2 * MARGIN.top - MARGIN.bottom;
    const upper = Math.round(FORCE_SHARE * room);
    force.place(MARGIN.left, MARGIN.top, across, upper);
    depth.place(MARGIN.left, 2 * MARGIN.top + upper, across, room - upper);
    const { window } = picture;
    this.measure(picture, now, from);
    const { forces, depths } = this;
    const forceChanged = this.rangeForce.follow(forces.low, forces.high, now);
    // While the hand is far from the tissue, the range must not flatten the curve inside it.
    const deep = Math.max(depths.low, -Math.max(10, 1.5 * depths.high));
    const depthChanged = this.rangeDepth.follow(deep, depths.high, now);
    for (const pane of [force, depth]) pane.rangeX(window.from, window.to);
    force.rangeY(this.rangeForce.min, this.rangeForce.max);
    depth.rangeY(this.rangeDepth.min, this.rangeDepth.max);
    return forceChanged || depthChanged;
  }

  private measure(picture: TimePicture, now: number, from: number | null): void {
    const { forces, depths } = this;
    const { window } = picture;
    const all = from === null || !(now - this.scanned < SCAN_S);
    if (all) {
      this.scanned = now;
      forces.forget();
      depths.forget();
      for (const [extent, least] of [[forces, 0.1], [depths, 1]] as const) {
        extent.take(-least);
        extent.take(least);
      } // biome-ignore format: a table
    }
    this.lines.measure(picture, all ? window.first : Math.max(from, window.first), window.end, forces, depths);
  }

  /** Draws the whole plot. */
  draw(pen: Pen, picture: TimePicture, theme: Theme): void {
    this.drawBack(pen, picture, theme);
    this.drawLines(pen, picture, theme);
    this.drawFront(pen, picture, theme);
  }

  /** Draws the background, which stays the same while the window stays. */
  drawBack(pen: Pen, picture: TimePicture, theme: Theme): void {
    const { source, window, hidden } = picture;
    drawStates(pen, this.force, this.depth, source.history, window, theme);
    if (hidden.shows("cut")) drawLimits(pen, this.force, source.history, window, theme);
    drawAxes(pen, this.force, theme, { y: "force (N)" });
    drawAxes(pen, this.depth, theme, { x: "time (s)", y: "depth along the needle (mm)" });
    drawMarks(pen, this.force, this.depth, source, window, theme);
    if (hidden.shows("found")) drawFound(pen, this.force, this.depth, source, window, theme);
    this.drawMeans(pen, picture, theme);
  }

  /** Draws all curves of the window. */
  drawLines(pen: Pen, picture: TimePicture, theme: Theme): void {
    this.lines.draw(pen, picture, picture.window.first, picture.window.end, theme);
  }

  /** From where on the curves change when ticks from `end` on are added, px. */
  edgeOf({ source, window }: TimePicture, end: number): number {
    const last = Math.max(window.first, end - 1);
    return Math.max(0, Math.floor(this.force.x.px(source.history.timeOf(last)) - EDGE));
  }

  /** Draws the curves to the right of `edge`, px. The caller clips the rest. */
  drawNewLines(pen: Pen, picture: TimePicture, edge: number, theme: Theme): void {
    const { source, window } = picture;
    const first = tickAt(source.history, this.force.x.value(edge - EDGE)) - 1;
    this.lines.draw(pen, picture, Math.max(window.first, first), window.end, theme);
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

  /** Draws the foreground: the present tick and the pointed tick. */
  drawFront(pen: Pen, picture: TimePicture, theme: Theme): void {
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
    if (inside(last)) this.drawNames(pen, picture, last, theme);
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

  /** The curves' names at the last tick. Of the forces, only those that are not at zero, and not at another one. */
  private drawNames(pen: Pen, { source, hidden }: TimePicture, last: number, theme: Theme): void {
    const { history } = source;
    const { force, depth } = this;
    const x = force.x.px(history.timeOf(last));
    const shown = shownMembranes(history, hidden);
    const depths = shown.map((i) => endAt(source, i, x, depth.y.px(history.row("depth", last)[i]! * MM), theme));
    drawEnds(pen, depth, depths, theme);
    const slot = history.slot(last);
    const sums = [
      ["felt", feltForce(scaleOf(source)), "force"],
      ["model", MODEL_FORCE, "model_force"],
    ] as const;
    const all: End[] = [
      ...shown.map((i) => endAt(source, i, x, force.y.px(-history.row("axial_force", last)[i]!), theme)),
      ...sums.flatMap(([id, text, column]) => {
        const y = force.y.px(signedSize(history, column, slot));
        return hidden.shows(id) ? [{ x, y, text, colour: theme.text }] : [];
      }),
    ];
    const [zero, near] = [force.y.px(0), 5];
    const ends = all.filter(
      ({ y }, i) => Math.abs(y - zero) > near && !all.slice(0, i).some((one) => Math.abs(one.y - y) < near),
    );
    drawEnds(pen, force, ends, theme);
  }
}
