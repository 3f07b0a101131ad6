import type { Plots } from "./shared.ts";

/** Handles a key press on a plot: moves the pointed tick, freezes or zooms. Returns whether the key has a meaning. */
export function keyTick(event: KeyboardEvent, plots: Plots): boolean {
  const { window, source } = plots;
  const { history } = source;
  if (event.key === "Escape") {
    plots.pointed.value = null;
    return true;
  }
  if (event.key === " ") {
    if (plots.frozen.value) plots.unfreeze();
    else plots.freeze();
    return true;
  }
  if (event.key === "+" || event.key === "-") {
    zoomBy(plots, event.key === "+" ? 0.5 : 2);
    return true;
  }
  const span = window.end - window.first;
  const step = event.shiftKey ? 1 : Math.max(1, Math.round(span / 400));
  const now = plots.pointed.value ?? Math.min(window.end, history.end) - 1;
  const to = {
    ArrowLeft: now - step,
    ArrowRight: now + step,
    PageUp: now - Math.round(span / 10),
    PageDown: now + Math.round(span / 10),
    Home: window.first,
    End: window.end - 1,
  }[event.key];
  if (to === undefined || span <= 0) return false;
  plots.pointedBy = "keys";
  plots.pointed.value = Math.min(Math.max(to, window.first), window.end - 1);
  return true;
}

/** Multiplies the length of the window by `factor`, about the pointed tick. */
function zoomBy(plots: Plots, factor: number): void {
  const { window, source } = plots;
  const middle =
    plots.pointed.value === null ? (window.from + window.to) / 2 : source.history.timeOf(plots.pointed.value);
  const half = Math.max(0.005, ((window.to - window.from) * factor) / 2);
  if (2 * half >= plots.span.value) plots.resetZoom();
  else plots.zoomTo(middle - half, middle + half);
}
