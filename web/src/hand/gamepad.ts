import type { Hand } from "./hand.ts";
import { add, scaled } from "./vectors.ts";

const IDLE = 0.12; // of a stick's way: they never rest at 0
const FASTEST = 0.025; // m/s
const TURNING = 0.8; // rad/s
const FULL_DROP = 0.5; // N

/** A stick's way from -1 to 1 as a speed: nothing at rest, fine near it. */
export function stick(value: number | undefined): number {
  const way = Math.abs(value ?? 0);
  if (!(way > IDLE)) return 0;
  return Math.sign(value!) * Math.min(1, (way - IDLE) / (1 - IDLE)) ** 2;
}

/** The first gamepad that there is; browsers show one only after a button of it was pressed. */
export function firstGamepad(): Gamepad | null {
  return navigator.getGamepads?.().find((pad) => pad?.connected) ?? null;
}

/** A gamepad that leads the hand. Sticks that were held when a new run began must come to rest first. */
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
 * Moves the hand: left stick along the needle (forward is in) and to the side, right stick tilts and goes towards the viewer. True where
 * something moved.
 */
export function moveByGamepad(pad: Gamepad, hand: Hand, seconds: number): boolean {
  const [side, back, turn, near] = pad.axes.map(stick);
  if (!side && !back && !turn && !near) return false;
  const pose = hand.pose();
  if (!pose) return false;
  const way = FASTEST * seconds;
  const deep = add(pose.position, scaled(pose.axis, -(back ?? 0) * way));
  const aside = add(deep, scaled(hand.side(), (side ?? 0) * way));
  hand.moveTo(add(aside, [0, 0, (near ?? 0) * way]));
  if (turn) hand.setTilt(hand.tilt() + turn * TURNING * seconds);
  return true;
}

/** A knock as strong as the drop of force, N, where pad and browser can. */
export function rumble(pad: Gamepad, drop: number): void {
  const strong = Math.min(1, 0.3 + Math.abs(drop) / FULL_DROP);
  const effect = { duration: 90, strongMagnitude: strong, weakMagnitude: 0.5 * strong };
  pad.vibrationActuator?.playEffect?.("dual-rumble", effect).catch(() => {});
}
