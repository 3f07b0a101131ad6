import type { Hand } from "../hand/hand.ts";
import { FIRM, type Thumb } from "../hand/thumb.ts";
import { scaled } from "../hand/vectors.ts";
import type { OrbitCamera } from "./camera.ts";

const STEP = 0.25e-3; // m
const LONG = 4;
const TURN = Math.PI / 90;

/** The keys and their actions, for the list on the page. */
export const KEYS: readonly (readonly [keys: string, what: string])[] = [
  ["↓ ↑", "in, out along the needle, 0.25 mm; with Shift 1 mm"],
  ["← →", "to the side, 0.25 mm; with Shift 1 mm"],
  ["PageDown PageUp", "towards you, away from you, 0.25 mm; with Shift 1 mm"],
  ["Q E", "tilt by 2°"],
  ["Home", "in front of the first membrane, aimed at its centre"],
  ["+ −", "zoom in, out"],
  ["A D W S", "orbit the scene"],
  ["R", "show the last pop again, slowly"],
  ["Space", "push the syringe's plunger, while held"],
  ["Alt + wheel", "push the syringe's plunger, while it turns towards you; turned back, let it go"],
];

/** Handles keys while the view has the focus. */
export function viewKeys(canvas: HTMLElement, hand: Hand, orbit: OrbitCamera, again: () => void, thumb: Thumb): void {
  let run = hand.run; // the run in which the last key was pressed
  canvas.addEventListener("keydown", (event) => {
    if (!event.repeat) run = hand.run;
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const step = STEP * (event.shiftKey ? LONG : 1);
    const actions: Readonly<Record<string, () => void>> = {
      ArrowDown: () => hand.push(step),
      ArrowUp: () => hand.push(-step),
      ArrowLeft: () => hand.moveBy(scaled(hand.side(), -step)),
      ArrowRight: () => hand.moveBy(scaled(hand.side(), step)),
      PageDown: () => hand.moveBy([0, 0, step]),
      PageUp: () => hand.moveBy([0, 0, -step]),
      q: () => hand.setTilt(hand.tilt() - TURN),
      e: () => hand.setTilt(hand.tilt() + TURN),
      Home: () => hand.home(),
      "+": () => orbit.zoom(1.15),
      "=": () => orbit.zoom(1.15),
      "-": () => orbit.zoom(1 / 1.15),
      a: () => orbit.orbit(-12, 0),
      d: () => orbit.orbit(12, 0),
      w: () => orbit.orbit(0, 12),
      s: () => orbit.orbit(0, -12),
      r: again,
      " ": () => thumb.push("key", FIRM),
    };
    const act = actions[event.key.length === 1 ? event.key.toLowerCase() : event.key];
    if (!act) return;
    event.preventDefault();
    // A key held since an earlier run must be released first.
    if (!event.repeat || run === hand.run) act();
  });
  canvas.addEventListener("keyup", (event) => {
    if (event.key === " ") thumb.push("key", 0);
  });
  canvas.addEventListener("blur", () => thumb.push("key", 0));
}
