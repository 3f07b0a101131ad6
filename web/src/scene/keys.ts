import { everyFrame } from "../frames.ts";
import type { Hand } from "../hand/hand.ts";
import { FIRM, type Thumb } from "../hand/thumb.ts";
import { scaled } from "../hand/vectors.ts";
import type { OrbitCamera } from "./camera.ts";

const STEP = 0.25e-3; // m, of a key that is pressed
const LONG = 4;
const TURN = Math.PI / 90;
const STEPS_PER_S = 30; // while it is held: 7.5 mm/s, with Shift 30 mm/s, or 60°/s
const HELD_MS = 400; // a key that is down for less is a tap
const LONGEST_MS = 250; // of a frame: a page that stalled does not make up for it with a jump

/** The keys and their actions, for the list on the page. */
export const KEYS: readonly (readonly [keys: string, what: string])[] = [
  ["↓ ↑", "in, out along the needle, 0.25 mm; while held, 7.5 mm/s; with Shift four times as far"],
  ["← →", "to the side along the skin, in the same steps"],
  ["PageDown PageUp", "along the skin towards you, away from you, in the same steps"],
  ["Q E", "tilt by 2 degrees; while held, by 60 in a second"],
  ["Home", "in front of the first membrane, aimed at its centre"],
  ["+ −", "zoom in, out"],
  ["A D W S", "orbit the scene"],
  ["R", "show the last pop again, slowly"],
  ["Space", "push the syringe's plunger, while held, also while another key moves the needle"],
  ["Alt + wheel", "push the syringe's plunger, while it turns towards you; turned back, let it go"],
];

/** Handles keys while the view has the focus. A held key moves the needle by time, whatever other keys do. */
export function viewKeys(canvas: HTMLElement, hand: Hand, orbit: OrbitCamera, again: () => void, thumb: Thumb): void {
  let run = hand.run; // the run in which the last key was pressed
  let long = 1;
  /** The keys that move the needle. steps: of STEP or TURN, a part of one in a frame. */
  const moves: Readonly<Record<string, (steps: number) => void>> = {
    ArrowDown: (steps) => hand.push(STEP * long * steps),
    ArrowUp: (steps) => hand.push(-STEP * long * steps),
    ArrowLeft: (steps) => hand.moveBy(scaled(hand.side(), -STEP * long * steps)),
    ArrowRight: (steps) => hand.moveBy(scaled(hand.side(), STEP * long * steps)),
    PageDown: (steps) => hand.moveBy(scaled(hand.near(), STEP * long * steps)),
    PageUp: (steps) => hand.moveBy(scaled(hand.near(), -STEP * long * steps)),
    q: (steps) => hand.setTilt(hand.tilt() - TURN * steps),
    e: (steps) => hand.setTilt(hand.tilt() + TURN * steps),
  };
  const actions: Readonly<Record<string, () => void>> = {
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
  const keyOf = ({ key }: KeyboardEvent): string => (key.length === 1 ? key.toLowerCase() : key);
  /**
   * The keys that are down and move the needle, with the time until which each has moved it, ms. At first that time is
   * to come: it may be a tap. A repeat of the keyboard or another key tells before it that the key is held.
   */
  const held = new Map<string, number>();
  let before: readonly string[] = []; // the keys that were held when the focus went away
  const release = (): void => {
    before = [...held.keys()];
    held.clear();
    thumb.push("key", 0);
  };

  canvas.addEventListener("keydown", (event) => {
    // macOS sends no keyup of a key that is released while Command is held.
    if (event.ctrlKey || event.metaKey || event.altKey) return release();
    const key = keyOf(event);
    const move = moves[key];
    const act = actions[key];
    if (!move && !act) return;
    event.preventDefault();
    long = event.shiftKey ? LONG : 1;
    // A key held since an earlier run must be released first.
    if (!event.repeat) run = hand.run;
    else if (run !== hand.run) return;
    const now = performance.now();
    for (const [each, until] of held) if (each !== key || event.repeat) held.set(each, Math.min(until, now));
    act?.();
    if (!move || held.has(key) || (event.repeat && !before.includes(key))) return;
    if (!event.repeat) move(1);
    held.set(key, event.repeat ? now : now + HELD_MS);
  });
  everyFrame((now) => {
    if (run !== hand.run) held.clear();
    for (const [key, until] of held) {
      if (now <= until) continue;
      moves[key]!((Math.min(now - until, LONGEST_MS) / 1e3) * STEPS_PER_S);
      held.set(key, now);
    }
  });
  canvas.addEventListener("keyup", (event) => {
    held.delete(keyOf(event));
    if (event.key === "Shift") long = 1;
    if (event.key === " ") thumb.push("key", 0);
  });
  canvas.addEventListener("blur", release);
}
