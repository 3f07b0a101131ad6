import { everyFrame } from "../panel.ts";
import type { App } from "../state/app.ts";

const EVERY_MS = 100;

/**
 * Tells the studio in each frame, ten times a second at most, that this page can move the hand of a running exercise. A
 * page that stalls is silent, so its needle that stands still is no pause of the student.
 */
export function tellAwake(app: App): void {
  let last = Number.NEGATIVE_INFINITY;
  everyFrame((now) => {
    const moves = app.control.value.you && app.hello.value?.device.simulated;
    if (!moves || !app.exercise.value?.running || now - last < EVERY_MS) return;
    last = now;
    app.engine.awake?.();
  });
}
