import type { App } from "../state/app.ts";
import { onePerApp } from "../state/one_per_app.ts";
import { Signal } from "../state/signal.ts";
import type { Source } from "../state/source.ts";
import { frozenCopy } from "./freeze.ts";
import { Window } from "./window.ts";

export const SPANS = [2, 5, 20, 80] as const; // s
export type Span = (typeof SPANS)[number];

/** What all plots of a page have in common: they show the same ticks, and point at the same one. */
export class Plots {
  /** The copy that is looked at while the run goes on. */
  readonly frozen = new Signal<Source | null>(null);
  readonly span = new Signal<Span>(20);
  /** A part of the time that is looked at, s. */
  readonly zoom = new Signal<{ readonly from: number; readonly to: number } | null>(null);
  /** The tick that is pointed at. */
  readonly pointed = new Signal<number | null>(null);
  /** Who points: it lets go when the pointer leaves it. */
  pointedBy: "depth" | "time" | "keys" | null = null;
  readonly window = new Window();
  /** Width of the time plot, px. */
  width = 400;
  private frozenByZoom = false;

  constructor(private readonly app: App) {
    app.source.watch(() => this.thaw());
  }

  get source(): Source {
    return this.frozen.value ?? this.app.source.value;
  }

  /** Finds the ticks to draw: once a frame. */
  update(): Window {
    const { source, window } = this;
    const zoom = this.zoom.value;
    if (zoom) window.set(source.history, zoom.from, zoom.to);
    else
      window.follow(
        source.history,
        source.shown(),
        this.span.value,
        source.live || this.frozen.value !== null,
        this.span.value / this.width,
      );
    return window;
  }

  freeze(): void {
    if (this.frozen.value || !this.app.source.value.live) return;
    this.frozen.value = frozenCopy(this.app.source.value);
    this.frozenByZoom = false;
  }

  thaw(): void {
    this.frozen.value = null;
    this.zoom.value = null;
    this.pointed.value = null;
  }

  /** Looks at a part of the time; what is live is frozen for that. */
  zoomTo(from: number, to: number): void {
    const byZoom = this.app.source.value.live && !this.frozen.value;
    this.freeze();
    this.frozenByZoom ||= byZoom;
    this.zoom.value = { from, to };
  }

  resetZoom(): void {
    this.zoom.value = null;
    if (this.frozenByZoom) this.thaw();
  }

  /** Shows what happened at a tick. Whether it is still there. */
  jump(tick: number): boolean {
    const { history } = this.source;
    if (tick < history.first || tick >= history.end) return false;
    const time = history.timeOf(tick);
    const half = Math.min(1, this.span.value / 2);
    this.zoomTo(time - half, time + half);
    if (!this.app.source.value.live) this.app.source.value.cursor.value = tick;
    this.pointedBy = "keys";
    this.pointed.value = tick;
    return true;
  }
}

/** The one of this page. */
export const plotsOf = onePerApp((app) => new Plots(app));
