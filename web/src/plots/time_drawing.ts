import type { History } from "../state/history.ts";
import type { Source } from "../state/source.ts";
import { AutoRange } from "./auto_range.ts";
import { drawAxes, MARGIN, Pane } from "./axes.ts";
import { drawBadge } from "./badge.ts";
import { decimate } from "./decimate.ts";
import { Extent, gather, gatherOther, gatherSent, gatherTime, isCompared } from "./gather.ts";
import { drawKey, type KeyEntry, otherName } from "./key.ts";
import type { Pen } from "./pen.ts";
import { Polyline } from "./polyline.ts";
import { drawReading } from "./reading.ts";
import type { Scale } from "./scale.ts";
import { colourOf, type Theme } from "./theme.ts";
import { drawLimits, drawMarks, drawStates, limitKey } from "./time_marks.ts";
import type { Window } from "./window.ts";

const MM = 1e3;
const FORCE_SHARE = 0.58;

/** The window of ticks to draw. Depths in mm; forces in N, positive if they push the needle out. */
export interface TimePicture {
  readonly source: Source;
  readonly window: Window;
  readonly pointed: number | null;
  /** The tick of a recording's scrubber. */
  readonly cursor: number | null;
}

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
  arrange({ source, window }: TimePicture, width: number, height: number, now: number): void {
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
    for (let i = 0; i < history.membranes; i++)
      extent.takeColumn(history, window.first, window.end, "axial_force", i, -1);
    this.room(window.end - window.first);
    gatherSent(history, window.first, window.end, 1, 0, this.ys);
    extent.takeNumbers(this.ys, window.end - window.first);
    this.rangeForce.follow(extent.low, extent.high, now);
    extent.forget();
    extent.take(-1);
    extent.take(1);
    for (let i = 0; i < history.membranes; i++) extent.takeColumn(history, window.first, window.end, "depth", i, MM);
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
    const { source, window } = picture;
    drawStates(pen, this.force, this.depth, source.history, window, theme);
    drawLimits(pen, this.force, source.history, window, theme);
    drawAxes(pen, this.force, theme, { y: "force (N)" });
    drawAxes(pen, this.depth, theme, { x: "time (s)", y: "depth (mm)" });
    drawMarks(pen, this.force, this.depth, source, window, theme);
    const key: KeyEntry[] = [{ text: "sent to the hand", colour: theme.text }];
    if (isCompared(source.history, window.first, window.end))
      key.push({ text: otherName(source), colour: theme.quiet });
    key.push(...limitKey(source.history, window, theme));
    drawKey(pen, this.depth.left + this.depth.width, this.depth.top - 9, key, theme);
    this.drawLines(pen, source.history, window.first, window.end, theme);
  }

  /** Draws the foreground: the new ticks, from the tick `from` on, the present tick and the pointed tick. */
  drawFront(pen: Pen, picture: TimePicture, from: number, theme: Theme): void {
    const { source, window } = picture;
    this.drawLines(pen, source.history, Math.max(window.first, from - 1), window.end, theme);
    this.drawNow(pen, picture, theme);
  }

  private drawLines(pen: Pen, history: History, first: number, end: number, theme: Theme): void {
    const n = end - first;
    if (n < 2) return;
    this.room(n);
    const { force, depth } = this;
    const slope = slopeOf(force.x);
    gatherTime(history, first, end, slope, force.x.from - slope * force.x.min, this.xs);
    pen.within(force.left, force.top, force.width, force.height, () =>
      this.drawForces(pen, history, first, end, theme),
    );
    pen.within(depth.left, depth.top, depth.width, depth.height, () => {
      for (let i = 0; i < history.membranes; i++) {
        gather(history, first, end, "depth", i, MM * slopeOf(depth.y), depth.y.px(0), this.ys);
        this.drawLine(pen, n, colourOf(theme, i), 1.5, 1);
      }
    });
  }

  private room(n: number): void {
    if (this.xs.length >= n) return;
    this.xs = new Float32Array(2 * n);
    this.ys = new Float32Array(2 * n);
  }

  private drawForces(pen: Pen, history: History, first: number, end: number, theme: Theme): void {
    const { y } = this.force;
    const gain = slopeOf(y);
    const n = end - first;
    gatherSent(history, first, end, gain, y.px(0), this.ys);
    this.drawLine(pen, n, theme.text, 1.25, 0.8);
    const compared = isCompared(history, first, end);
    for (let i = 0; i < history.membranes; i++) {
      if (compared) {
        gatherOther(history, first, end, i, -gain, y.px(0), this.ys);
        this.drawLine(pen, n, theme.quiet, 1, 1);
      }
      gather(history, first, end, "axial_force", i, -gain, y.px(0), this.ys);
      this.drawLine(pen, n, colourOf(theme, i), 1.5, 1);
    }
  }

  private drawLine(pen: Pen, n: number, colour: string, width: number, alpha: number): void {
    this.path.clear();
    decimate(this.xs, this.ys, 0, n, this.path);
    if (this.path.count) pen.line(this.path, { colour, width, alpha });
  }

  private drawNow(pen: Pen, picture: TimePicture, theme: Theme): void {
    const { source, window, pointed, cursor } = picture;
    const { history } = source;
    const { force, depth } = this;
    const bottom = depth.top + depth.height;
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
      for (let i = history.membranes - 1; i >= 0; i--) {
        const y = depth.y.px(history.row("depth", last)[i]! * MM);
        if (depth.holds(x, y)) drawBadge(pen, Math.min(x, depth.left + depth.width - 8), y, i, theme);
      }
    }
    if (inside(pointed)) {
      const x = force.x.px(history.timeOf(pointed));
      pen.segment(x, force.top, x, bottom, { colour: theme.text, width: 1, alpha: 0.6, dash: [3, 3] });
      for (let i = 0; i < history.membranes; i++) {
        const places = [
          [force, -history.row("axial_force", pointed)[i]!],
          [depth, history.row("depth", pointed)[i]! * MM],
        ] as const;
        for (const [pane, value] of places) {
          const y = pane.y.px(value);
          if (pane.holds(x, y)) pen.dot(x, y, 3, theme.panel, colourOf(theme, i));
        }
      }
      drawReading(pen, force, source, pointed, theme);
    }
  }
}

const slopeOf = ({ min, max, from, to }: Scale): number => (to - from) / (max - min);
