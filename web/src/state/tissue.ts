import type { App } from "./app.ts";

/** Whether the tip is behind the surface of a membrane; null if its position is not known. */
export function inTissue(app: App): boolean | null {
  const { history, scene } = app.live;
  if (history.length === 0 || !scene.value) return null;
  const tip = history.row("position", history.end - 1);
  if (![...tip].every(Number.isFinite)) return null;
  return scene.value.membranes.some(
    ({ point, inward_normal: inward }) => inward.reduce((sum, n, i) => sum + n * (tip[i]! - point[i]!), 0) > 0,
  );
}
