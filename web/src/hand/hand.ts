import type { Triple } from "../engine/engine.ts";
import type { App } from "../state/app.ts";
import { onePerApp } from "../state/one_per_app.ts";
import { Signal } from "../state/signal.ts";
import type { HandPose } from "../wire/messages.ts";
import { aiming, heightOver } from "./aim.ts";
import { add, alongSkin, length, scaled, sub, tilted, tiltOf, unit } from "./vectors.ts";

const FARTHEST = 0.25; // m from the scene's origin: nobody means more
const STEEPEST = 1.3; // rad from the normal: the model takes no flatter entry than 80 degrees

export interface Pose {
  readonly position: Triple;
  readonly axis: Triple;
}

const poseOf = ({ position: [x = 0, y = 0, z = 0], axis: [a = 0, b = -1, c = 0] }: HandPose): Pose => ({
  position: [x, y, z],
  axis: unit([a, b, c]),
});

/** The simulated hand, as the page moves it: where it shall go, m, and where the needle points. */
export class Hand {
  /** Where this page wants the hand; null while something else leads it. */
  readonly target = new Signal<Pose | null>(null);
  /** Why it cannot be moved from here, in words; null where it can. */
  readonly barred = new Signal<string | null>("The studio is not connected yet.");

  constructor(private readonly app: App) {
    const look = (): void => {
      this.barred.value = this.reason();
      if (this.barred.value) this.target.value = null;
    };
    app.hello.watch(look);
    let you = false;
    app.control.watch((control) => {
      look();
      // Who gets control leads the hand on from where it is, which is not where tissue holds the needle back.
      if (control.you && !you && control.hand && !this.barred.value) this.target.value = poseOf(control.hand);
      you = control.you;
    });
    app.connection.watch(look);
    app.source.watch(look);
    // A new run begins where the server puts the hand, not where it was.
    app.run.watch(() => {
      this.target.value = null;
    });
    app.status.watch((status) => {
      if (status && (status.hand === "strokes" || status.hand === "motion") && !this.fresh) this.target.value = null;
    });
  }
  private touched = Number.NEGATIVE_INFINITY;
  /** A status that was on its way when the hand was taken must not take it back. */
  private get fresh(): boolean {
    return performance.now() - this.touched < 600;
  }

  /** The number of the live run: what moved the hand before it began must be let go and taken anew. */
  get run(): number {
    return this.app.run.value;
  }

  private reason(): string | null {
    const { connection, hello, control, source } = this.app;
    if (connection.value.state !== "open" || !hello.value) return "The studio is not connected.";
    if (!hello.value.device.simulated) return `${hello.value.device.model} is the hand now: move its stylus.`;
    if (!source.value.live) return "A recording is shown. Go back to the live run to move the needle.";
    if (!control.value.you) return "Another page has control.";
    return null;
  }

  /** Where the hand is led to now, or else where the needle is. */
  pose(): Pose | null {
    if (this.target.value) return this.target.value;
    const { history } = this.app.live;
    if (history.length === 0) return null;
    const tick = history.end - 1;
    const [x = 0, y = 0, z = 0] = history.row("position", tick);
    const axis = history.row("axis", tick);
    return { position: [x, y, z], axis: unit([axis[0] ?? 0, axis[1] ?? -1, axis[2] ?? 0]) };
  }

  moveTo(position: Triple, axis?: Triple): void {
    const now = this.pose();
    if (this.barred.value || !now || !position.every(Number.isFinite)) return;
    const away = length(position);
    const to: Pose = {
      position: away > FARTHEST ? scaled(position, FARTHEST / away) : position,
      axis: axis ?? now.axis,
    };
    this.touched = performance.now();
    this.target.value = to;
    this.app.engine.target(this.run, to.position, to.axis);
  }

  /** Something else leads the hand from now on. */
  release(): void {
    this.touched = Number.NEGATIVE_INFINITY;
    this.target.value = null;
  }
  /** Stays where the needle is now. */
  hold(): void {
    this.release();
    const now = this.pose();
    if (now) this.moveTo(now.position, now.axis);
  }

  /** Along the needle, m; positive goes in. */
  push(depth: number): void {
    const now = this.pose();
    if (now) this.moveTo(add(now.position, scaled(now.axis, depth)));
  }

  moveBy(step: Triple): void {
    const now = this.pose();
    if (now) this.moveTo(add(now.position, step));
  }

  /** rad between the needle and the first membrane's inward normal, leaning along +x; 0 while nothing is known of it. */
  tilt(): number {
    const now = this.pose();
    return now ? tiltOf(now.axis, this.normal()) : 0;
  }
  /** In tissue the needle turns about its tip; in front of it so that it aims at the middle of the scene, as far from the skin as before. */
  setTilt(angle: number): void {
    const now = this.pose();
    if (!now) return;
    const axis = tilted(Math.max(-STEEPEST, Math.min(STEEPEST, angle)), this.normal());
    const scene = this.app.live.scene.value;
    const before = scene ? heightOver(scene, now.position) : 0;
    this.moveTo(scene && before > 0 ? aiming(scene, axis, before) : now.position, axis);
  }

  /** In front of the first membrane, m away from it, aiming at the middle of the scene. */
  home(height = 0.005): void {
    const now = this.pose();
    const scene = this.app.live.scene.value;
    if (now && scene) this.moveTo(aiming(scene, now.axis, height));
  }

  normal(): Triple {
    return this.app.live.scene.value?.membranes[0]?.inward_normal ?? [0, -1, 0];
  }
  /** In the face of the first membrane: the way that the needle leans. */
  side(): Triple {
    return alongSkin(this.normal());
  }
  /** How far the needle is behind the hand, m; null where nobody leads the hand from here. */
  lag(): number | null {
    const { history } = this.app.live;
    if (!this.target.value || history.length === 0) return null;
    const [x = 0, y = 0, z = 0] = history.row("tip", history.end - 1);
    return length(sub(this.target.value.position, [x, y, z]));
  }
}

/** The one hand of this page. */
export const handOf = onePerApp((app) => new Hand(app));
