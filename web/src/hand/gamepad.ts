import type { Hand } from "./hand.ts";
import { add, scaled } from "./vectors.ts";

const IDLE = 0.12; // dead zone, as a share of the stick's range: sticks do not rest exactly at 0
const FASTEST = 0.025; // m/s
const TURNING = 0.8; // rad/s
const FULL_DROP = 0.5; // N

/** Converts a stick's position, -1 to 1, to a speed: 0 at rest, with fine control near it. */
export function stick(value: number | undefined): number {
  const way = Math.abs(value ?? 0);
  if (!(way > IDLE)) return 0;
  return Math.sign(value!) * Math.min(1, (way - IDLE) / (1 - IDLE)) ** 2;
}

/** The first connected gamepad; browsers show it only after one of its buttons was pressed. */
export function firstGamepad(): Gamepad | null {
  return navigator.getGamepads?.().find((pad) => pad?.connected) ?? null;
}

/** Moves the hand by a gamepad. After a new run begins, all sticks must come to rest first. */
export class Sticks {
  private run: number;
  private rested = true;

  constructor(private readonly hand: Hand) {
    this.run = hand.run;
  }

  lead(pad: Gamepad, seconds: number): void {
    if (this.run !== this.hand.run) this.rested = false;
    this.run = this.hand.run;
    this.rested ||= pad.axes.slice(0, 4).every((way) => stick(way) === 0);
    if (this.rested && !this.hand.barred.value) moveByGamepad(pad, this.hand, seconds);
  }
}

/**
 * Moves the hand. The left stick moves along the needle (forward is in) and to the side. The right stick tilts the
 * needle and moves it towards the viewer. Returns whether the hand moved.
 */
function moveByGamepad(pad: Gamepad, hand: Hand, seconds: number): boolean {
  const [side, back, turn, near] = pad.axes.map(stick);
  if (!side && !back && !turn && !near) return false;
  const pose = hand.pose();
  if (!pose) return false;
  const way = FASTEST * seconds;
  const deep = add(pose.position, scaled(pose.axis, -(back ?? 0) * way));
  const aside = add(deep, scaled(hand.side(), (side ?? 0) * way));
  hand.moveTo(add(aside, scaled(hand.near(), (near ?? 0) * way)));
  if (turn) hand.setTilt(hand.tilt() + turn * TURNING * seconds);
  return true;
}

/** Vibrates a phone: longer for a larger drop of force, N. Browsers allow it after a touch of the page. */
export function buzz(drop: number): void {
  if (navigator.userActivation?.hasBeenActive) navigator.vibrate?.(20 + 40 * Math.min(1, Math.abs(drop) / FULL_DROP));
}

/** Vibrates in proportion to the drop of force, N, if gamepad and browser can. */
export function rumble(pad: Gamepad, drop: number): void {
  const strong = Math.min(1, 0.3 + Math.abs(drop) / FULL_DROP);
  const effect = { duration: 90, strongMagnitude: strong, weakMagnitude: 0.5 * strong };
  pad.vibrationActuator?.playEffect?.("dual-rumble", effect).catch(() => {});
}
