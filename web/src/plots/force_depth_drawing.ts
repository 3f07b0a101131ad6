import type { Source } from "../state/source.ts";
import type { LawCurve } from "../wire/messages.ts";
import { drawAxes, MARGIN, Pane } from "./axes.ts";
import { drawBadge } from "./badge.ts";
import { CalmRange } from "./calm_range.ts";
import { throughColumns } from "./decimate.ts";
import { Extent, gather, gatherOther, isCompared } from "./gather.ts";
import { drawKey, type KeyEntry, otherName } from "./key.ts";
import { Painted } from "./painted.ts";
import type { Pen, Stroke } from "./pen.ts";
import { Polyline } from "./polyline.ts";
import { colourOf, type Theme } from "./theme.ts";
import type { Window } from "./window.ts";

const MM = 1e3;
const AGES = 8; // steps in which the hand's history fades
const WIDTH = 1.6; // px
const OUTSIDE = 0.35; // share of the depth inside that is shown before the surface

export interface Area {
  readonly x: readonly [number, number];
  readonly y: readonly [number, number];
}

/** What is to be drawn: ticks of a source. Depths in mm, forces in N, positive where they push the needle out. */
export interface ForceDepthPicture {
  readonly source: Source;
  readonly window: Window;
  /** The present tick; nothing after it is drawn. */
  readonly shown: number | null;
  /** One membrane, or null for all. */
  readonly chosen: number | null;
  readonly overlay: Source | null;
  readonly zoom: Area | null;
  /** How much of the oldest tick is to be seen, 0 to 1. */
  readonly oldest: number;
  readonly pointed: { readonly tick: number; readonly membrane: number } | null;
}

/** Draws force against depth. Keeps its memory from frame to frame. */
export class ForceDepthDrawing {
  readonly pane = new Pane();
  private readonly rangeX = new CalmRange();
  private readonly rangeY = new CalmRange();
  private readonly extentX = new Extent();
  private readonly extentY = new Extent();
  private readonly path = new Polyline();
  private readonly fresh = new Polyline();
  private readonly painted = new Painted();
  private xs = new Float32Array(0);
  private ys = new Float32Array(0);

  /** Whether a membrane is drawn. */
  static draws(picture: ForceDepthPicture, membrane: number): boolean {
    return picture.chosen === null || picture.chosen === membrane;
  }

  /** Lays the axes out for `picture`; now in s. */
  arrange(picture: ForceDepthPicture, width: number, height: number, now: number): void {
    const { pane, extentX, extentY } = this;
    pane.place(MARGIN.left, MARGIN.top, width - MARGIN.left - MARGIN.right, height - MARGIN.top - MARGIN.bottom);
    if (picture.zoom) {
      pane.rangeX(...picture.zoom.x);
      pane.rangeY(...picture.zoom.y);
      return;
    }
    extentX.forget();
    extentY.forget();
    extentY.take(-0.1);
    extentY.take(0.1);
    extentX.take(2);
    picture.source.laws.value.forEach((law, i) => {
      if (!ForceDepthDrawing.draws(picture, i)) return;
      for (const force of law.lower) extentY.take(-force);
      for (const force of law.upper) extentY.take(-force);
      extentX.take(1.2 * law.through * MM);
    });
    const { history } = picture.source;
    const { first } = picture.window;
    const end = this.end(picture);
    for (let i = 0; i < history.membranes; i++) {
      if (!ForceDepthDrawing.draws(picture, i)) continue;
      extentX.takeColumn(history, first, end, "depth", i, MM);
      extentY.takeColumn(history, first, end, "axial_force", i, -1);
    }
    for (const i of this.overlaid(picture)) {
      const { history } = picture.overlay!;
      extentY.takeColumn(history, history.first, history.end, "axial_force", i, -1);
    }
    const before = Math.max(Math.min(extentX.low, 0), -OUTSIDE * extentX.high); // the way to the skin is long and empty
    this.rangeX.follow(before, extentX.high, now);
    this.rangeY.follow(extentY.low, extentY.high, now);
    pane.rangeX(this.rangeX.min, this.rangeX.max);
    pane.rangeY(this.rangeY.min, this.rangeY.max);
  }

  /** All of it. */
  draw(pen: Pen, picture: ForceDepthPicture, theme: Theme): void {
    this.drawBack(pen, picture, theme);
    this.drawFront(pen, picture, this.end(picture), theme);
  }

  /** Bands, axes and the ticks so far. */
  drawBack(pen: Pen, picture: ForceDepthPicture, theme: Theme): void {
    const { left, top, width, height } = this.pane;
    const { source, window, overlay } = picture;
    const end = this.end(picture);
    const membranes = Array.from({ length: source.history.membranes }, (_, i) => i).filter((i) =>
      ForceDepthDrawing.draws(picture, i),
    );
    pen.within(left, top, width, height, () => {
      source.laws.value.forEach((law, i) => {
        if (ForceDepthDrawing.draws(picture, i)) this.drawBand(pen, law, colourOf(theme, i));
      });
    });
    drawAxes(pen, this.pane, theme, { x: "depth (mm)", y: "force on the hand (N)" });
    const keys: KeyEntry[] = [];
    if (overlay) keys.push({ text: overlay.title, colour: theme.text });
    if (isCompared(source.history, window.first, end)) keys.push({ text: otherName(source), colour: theme.quiet });
    drawKey(pen, left + width, top - 9, keys, theme);
    pen.within(left, top, width, height, () => {
      for (const i of this.overlaid(picture)) this.drawOverlay(pen, overlay!, i, theme);
      this.drawOther(pen, source, window.first, end, membranes, theme);
      for (const i of membranes) this.drawHistory(pen, picture, i, theme);
    });
  }

  /** The ticks from `from` on, which came since, the present and what is pointed at. */
  drawFront(pen: Pen, picture: ForceDepthPicture, from: number, theme: Theme): void {
    const { left, top, width, height } = this.pane;
    const { source, window } = picture;
    const first = Math.max(window.first, from - 1);
    const end = this.end(picture);
    pen.within(left, top, width, height, () => {
      for (let i = 0; i < source.history.membranes && end - first > 1; i++) {
        if (!ForceDepthDrawing.draws(picture, i)) continue;
        this.drawOther(pen, source, first, end, [i], theme);
        const n = this.pixels(source, first, end, i);
        this.path.clear();
        throughColumns(this.xs, this.ys, 0, n, this.path);
        pen.line(this.path, { colour: colourOf(theme, i), width: WIDTH });
      }
      this.drawPresent(pen, picture, theme);
    });
  }

  /** The point among the ticks shown that is nearest to a place of the plot, at most `reach` px away. */
  nearest(picture: ForceDepthPicture, x: number, y: number, reach: number): { tick: number; membrane: number } | null {
    let least = reach * reach;
    let found: { tick: number; membrane: number } | null = null;
    const { first } = picture.window;
    for (let m = 0; m < picture.source.history.membranes; m++) {
      if (!ForceDepthDrawing.draws(picture, m)) continue;
      const n = this.pixels(picture.source, first, this.end(picture), m);
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

  /** The membranes of the earlier run that stand for those that are drawn: of one name, else of one place in the row. */
  private overlaid(picture: ForceDepthPicture): number[] {
    const { source, overlay } = picture;
    if (!overlay) return [];
    const names = overlay.scene.value?.membranes.map(({ name }) => name) ?? [];
    return Array.from({ length: source.history.membranes }, (_, i) => i)
      .filter((i) => ForceDepthDrawing.draws(picture, i))
      .map((i) => {
        const named = names.indexOf(source.scene.value?.membranes[i]?.name ?? "");
        return named < 0 ? i : named;
      })
      .filter((i) => i < overlay.history.membranes);
  }

  private end({ window, shown }: ForceDepthPicture): number {
    return shown === null ? window.end : Math.max(window.first, Math.min(window.end, shown + 1));
  }

  /** All ticks of a membrane as pixels into xs and ys; how many. */
  private pixels(source: Source, first: number, end: number, membrane: number): number {
    const n = Math.max(0, end - first);
    if (this.xs.length < n) {
      this.xs = new Float32Array(2 * n);
      this.ys = new Float32Array(2 * n);
    }
    const { x, y } = this.pane;
    const { history } = source;
    gather(history, first, end, "depth", membrane, MM * slope(x), x.px(0), this.xs);
    gather(history, first, end, "axial_force", membrane, -slope(y), y.px(0), this.ys);
    return n;
  }

  private drawBand(pen: Pen, law: LawCurve, colour: string): void {
    const { path } = this;
    const { x, y } = this.pane;
    const { depth } = law;
    path.clear();
    if (!depth.length) return;
    // Behind its last point a law is constant.
    const onwards = Math.max(depth.at(-1)! * MM, x.max);
    for (let i = 0; i < depth.length; i++) path.add(x.px(depth[i]! * MM), y.px(-law.lower[i]!));
    path.add(x.px(onwards), y.px(-law.lower.at(-1)!));
    path.add(x.px(onwards), y.px(-law.upper.at(-1)!));
    for (let i = depth.length - 1; i >= 0; i--) path.add(x.px(depth[i]! * MM), y.px(-law.upper[i]!));
    path.add(path.xs[0]!, path.ys[0]!);
    pen.area(path, colour, 0.13);
    pen.line(path, { colour, width: 1, alpha: 0.35 });
  }

  private drawOverlay(pen: Pen, overlay: Source, membrane: number, theme: Theme): void {
    const { first, end } = overlay.history;
    const n = this.pixels(overlay, first, end, membrane);
    this.drawNew(pen, 0, n, { colour: theme.text, width: 1.5, alpha: 0.7 }, true);
  }

  /** The hand's way, the older the fainter. */
  private drawHistory(pen: Pen, picture: ForceDepthPicture, membrane: number, theme: Theme): void {
    const { source, window, oldest } = picture;
    const end = this.end(picture);
    const n = this.pixels(source, window.first, end, membrane);
    const colour = colourOf(theme, membrane);
    const age = Math.max(1, Math.ceil((window.end - window.first) / AGES));
    // The newest first: what lies under it need not be drawn.
    for (let to = n, young = 1; to > 0; to -= age, young -= 1 / AGES) {
      const stroke = { colour, width: WIDTH, alpha: oldest + (1 - oldest) * Math.max(0, young) ** 2 };
      this.drawNew(pen, Math.max(0, to - age - 1), to, stroke, to === n);
    }
  }

  private drawOther(
    pen: Pen,
    source: Source,
    first: number,
    end: number,
    membranes: readonly number[],
    theme: Theme,
  ): void {
    const { history } = source;
    if (!isCompared(history, first, end)) return;
    const { y } = this.pane;
    for (const i of membranes) {
      const n = this.pixels(source, first, end, i);
      gatherOther(history, first, end, i, -slope(y), y.px(0), this.ys);
      this.drawNew(pen, 0, n, { colour: theme.quiet, width: 1 }, true);
    }
  }

  /** Draws the gathered pixels where there is no ink yet; `clean` forgets the ink. */
  private drawNew(pen: Pen, from: number, to: number, stroke: Stroke, clean: boolean): void {
    const { left, top, width, height } = this.pane;
    if (clean) this.painted.begin(left, top, width, height);
    this.path.clear();
    this.fresh.clear();
    throughColumns(this.xs, this.ys, from, to, this.path);
    this.painted.addNew(this.path, this.fresh);
    if (this.fresh.count) pen.line(this.fresh, stroke);
  }

  private drawPresent(pen: Pen, picture: ForceDepthPicture, theme: Theme): void {
    const { history } = picture.source;
    const { x, y } = this.pane;
    const last = this.end(picture) - 1;
    const place = (tick: number, membrane: number): [number, number] => [
      x.px(history.row("depth", tick)[membrane]! * MM),
      y.px(-history.row("axial_force", tick)[membrane]!),
    ];
    if (picture.pointed) {
      const [px, py] = place(picture.pointed.tick, picture.pointed.membrane);
      const hair = { colour: theme.text, width: 1, alpha: 0.5, dash: [3, 3] };
      pen.segment(px, this.pane.top, px, this.pane.top + this.pane.height, hair);
      pen.segment(this.pane.left, py, this.pane.left + this.pane.width, py, hair);
      pen.dot(px, py, 4, theme.panel, theme.text);
    }
    if (last < history.first || last >= history.end) return;
    for (let i = history.membranes - 1; i >= 0; i--) {
      if (!ForceDepthDrawing.draws(picture, i)) continue;
      const [px, py] = place(last, i);
      if (Number.isFinite(px + py)) drawBadge(pen, px, py, i, theme);
    }
  }
}

const slope = ({ min, max, from, to }: { min: number; max: number; from: number; to: number }): number =>
  (to - from) / (max - min);
