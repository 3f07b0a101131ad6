import { everyFrame } from "../panel.ts";
import type { App } from "../state/app.ts";
import type { SceneView } from "../wire/messages.ts";
import { Moment } from "./moment.ts";

/** Replaces the view if the browser has no WebGL: speaks the needle's state to a screen reader. */
export function followInWords(app: App, speak: (moment: Moment, scene: SceneView, now: number) => void): void {
  const moment = new Moment();
  everyFrame((now) => {
    const source = app.source.value;
    const scene = source.scene.value;
    if (scene && source.history.membranes === scene.membranes.length && moment.read(source)) speak(moment, scene, now);
  });
}
