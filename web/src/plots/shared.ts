import { busy } from "../frames.ts";
import { type App, onePerApp } from "../state/app.ts";
import { Signal } from "../state/signal.ts";
import type { Source } from "../state/source.ts";
import { Rest } from "./rest.ts";
import { Window } from "./window.ts";

export const SPANS = [2, 5, 20, 80] as const; // s
export type Span = (typeof SPANS)[number];
const BUSY_STEP = 4; // px
const REST_S = 1;

/** State shared by all plots of a page: the shown window of ticks, and who points at a tick. */
export class Plots {
  readonly span = new Signal<Span>(20);
  /** The zoomed part of the time, s. */
  readonly zoom = new Signal<{ readonly from: number; readonly to: number } | null>(null);
  /** The plot or keyboard that set the source's `pointed`. A plot clears it when the pointer leaves. */
  pointedBy: "depth" | "time" | "keys" | null = null;
  readonly window = new Window();
  /** Width of the time plot, px. */
  width = 400;
  /** Device pixels per px of the time plot. */
  ratio = 1;
  private pausedByZoom = false;

  constructor(private readonly app: App) {
    let before = app.source.value;
    app.source.watch((source) => {
      before.pointed.value = null;
      before = source;
      this.zoom.value = null;
    });
  }

  get source(): Source {
    return this.app.source.value;
  }

  /** Whether depths must be neither drawn, read out nor saved. */
  get noDepth(): boolean {
    return this.app.blind;
  }

  /** Finds the ticks to draw. Called once per frame. */
  update(): Window {
    const { source, window } = this;
    const zoom = this.zoom.value;
    const { excerpt, history } = source;
    if (zoom) window.set(history, zoom.from, zoom.to);
    else if (excerpt) window.set(history, history.timeOf(excerpt.first), history.timeOf(excerpt.last));
    else if (!this.waits()) {
      window.follow(history, source.present(), this.span.value, source.live, this.step());
      this.followed = `${source.title} ${history.generation} ${this.span.value} ${this.width}`;
    }
    return window;
  }

  /** A live run at rest moves the window once in REST_S only, so that nothing is drawn meanwhile. */
  private waits(): boolean {
    const { source, window } = this;
    const { history } = source;
    if (!source.live || source.cursor.value !== null) return false;
    const rests = this.rest.since(history, window.end);
    const same = this.followed === `${source.title} ${history.generation} ${this.span.value} ${this.width}`;
    const late = history.end - window.end > REST_S * (source.scene.value?.rate ?? 1000);
    return rests && same && !late && window.end > window.first && window.first >= history.first;
  }
  private readonly rest = new Rest();
  private followed = "";

  /** The step in which a window moves, s: whole device pixels, so that drawn curves can be moved. */
  private step(): number {
    const pixels = Math.max(1, Math.round((this.source.live && busy() ? BUSY_STEP : 1) * this.ratio));
    return (pixels / this.ratio) * (this.span.value / this.width);
  }

  /** Points at a tick; null: at none. */
  point(tick: number | null, by: "depth" | "time" | "keys"): void {
    this.pointedBy = by;
    this.source.pointed.value = tick;
  }

  /** Shows a part of the time. A live source is paused first. */
  zoomTo(from: number, to: number): void {
    const pauses = this.source.live;
    this.app.pause();
    this.pausedByZoom = pauses || (this.pausedByZoom && this.source.paused);
    this.zoom.value = { from, to };
  }

  resetZoom(): void {
    this.zoom.value = null;
    if (this.pausedByZoom && this.source.paused) this.app.goLive();
    this.pausedByZoom = false;
  }

  /** Zooms to a tick and moves the timeline there. Returns whether the history still holds it. */
  jump(tick: number): boolean {
    const { history } = this.source;
    if (tick < history.first || tick >= history.end) return false;
    const time = history.timeOf(tick);
    const half = Math.min(1, this.span.value / 2);
    this.zoomTo(time - half, time + half);
    this.source.cursor.value = tick;
    return true;
  }
}

/** The plots' state of this page. */
export const plotsOf = onePerApp((app) => new Plots(app));
