import type { App } from "../state/app.ts";
import type { Plots } from "./shared.ts";

/** Handles a key press on a plot: moves the moment, pauses or zooms. Returns whether the key has a meaning. */
export function keyTick(event: KeyboardEvent, plots: Plots, app: App): boolean {
  const { window, source } = plots;
  if (event.key === "Escape") {
    const pointed = source.pointed.value !== null;
    plots.point(null, "keys");
    return pointed;
  }
  if (event.key === " ") {
    if (source.paused) app.goLive();
    else app.pause();
    return true;
  }
  if (event.key === "+" || event.key === "-") {
    zoomBy(plots, event.key === "+" ? 0.5 : 2);
    return true;
  }
  const span = window.end - window.first;
  const step = event.shiftKey ? 1 : Math.max(1, Math.round(span / 400));
  const now = source.shown() ?? 0;
  const to = {
    ArrowLeft: now - step,
    ArrowRight: now + step,
    PageUp: now - Math.round(span / 10),
    PageDown: now + Math.round(span / 10),
    Home: window.first,
    End: window.end - 1,
  }[event.key];
  if (to === undefined || span <= 0) return false;
  const tick = Math.min(Math.max(to, window.first), window.end - 1);
  // The live run goes on under the keyboard cursor; a run that stands still moves with it.
  plots.point(source.live ? tick : null, "keys");
  if (!source.live) source.cursor.value = tick;
  return true;
}

/** Multiplies the length of the window by `factor`, about the moment. */
function zoomBy(plots: Plots, factor: number): void {
  const { window, source } = plots;
  const middle =
    source.live && source.pointed.value === null
      ? (window.from + window.to) / 2
      : source.history.timeOf(source.shown() ?? 0);
  const half = Math.max(0.005, ((window.to - window.from) * factor) / 2);
  if (2 * half >= plots.span.value) plots.resetZoom();
  else plots.zoomTo(middle - half, middle + half);
}
