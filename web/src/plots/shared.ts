import type { App } from "../state/app.ts";
import { frozenCopy } from "../state/frozen.ts";
import { onePerApp } from "../state/one_per_app.ts";
import { Signal } from "../state/signal.ts";
import type { Source } from "../state/source.ts";
import { Window } from "./window.ts";

export const SPANS = [2, 5, 20, 80] as const; // s
export type Span = (typeof SPANS)[number];

/** State shared by all plots of a page: the shown window of ticks and the pointed tick. */
export class Plots {
  /** The frozen copy that the plots show while the run goes on. */
  readonly frozen = new Signal<Source | null>(null);
  readonly span = new Signal<Span>(20);
  /** The zoomed part of the time, s. */
  readonly zoom = new Signal<{ readonly from: number; readonly to: number } | null>(null);
  /** The tick under the pointer or the keyboard cursor. */
  readonly pointed = new Signal<number | null>(null);
  /** The plot or keyboard that set `pointed`. A plot clears it when the pointer leaves. */
  pointedBy: "depth" | "time" | "keys" | null = null;
  readonly window = new Window();
  /** Width of the time plot, px. */
  width = 400;
  private frozenByZoom = false;

  constructor(private readonly app: App) {
    app.source.watch(() => this.unfreeze());
  }

  get source(): Source {
    return this.frozen.value ?? this.app.source.value;
  }

  /** Finds the ticks to draw. Called once per frame. */
  update(): Window {
    const { source, window } = this;
    const zoom = this.zoom.value;
    const { excerpt, history } = source;
    if (zoom) window.set(history, zoom.from, zoom.to);
    else if (excerpt) window.set(history, history.timeOf(excerpt.first), history.timeOf(excerpt.last));
    else
      window.follow(
        history,
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

  unfreeze(): void {
    this.frozen.value = null;
    this.zoom.value = null;
    this.pointed.value = null;
  }

  /** Shows a part of the time. A live source is frozen first. */
  zoomTo(from: number, to: number): void {
    const byZoom = this.app.source.value.live && !this.frozen.value;
    this.freeze();
    this.frozenByZoom ||= byZoom;
    this.zoom.value = { from, to };
  }

  resetZoom(): void {
    this.zoom.value = null;
    if (this.frozenByZoom) this.unfreeze();
  }

  /** Zooms to a tick. Returns whether the history still holds it. */
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

/** The plots' state of this page. */
export const plotsOf = onePerApp((app) => new Plots(app));
