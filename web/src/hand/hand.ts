import type { Connection, Triple } from "../engine/engine.ts";
import { everyFrame } from "../panel.ts";
import { type App, onePerApp } from "../state/app.ts";
import { controlWords } from "../state/control.ts";
import { Signal } from "../state/signal.ts";
import type { HandPose, SceneView } from "../wire/messages.ts";
import { add, alongSkin, dot, length, scaled, sub, tilted, tiltOf, towardsViewer, unit } from "./vectors.ts";

const FARTHEST = 0.25; // m from the scene's origin; larger distances are input errors
/**
 * The largest tilt that this page sets, degrees from the normal. It stays below 80 degrees, the grazing angle at which
 * the core refuses an entry (core/punctura/proxy/in_space.hpp).
 */
export const LARGEST_TILT_DEG = 75;
const LARGEST_TILT = (LARGEST_TILT_DEG * Math.PI) / 180; // rad

export interface Pose {
  readonly position: Triple;
  readonly axis: Triple;
}

const poseOf = ({ position: [x = 0, y = 0, z = 0], axis: [a = 0, b = -1, c = 0] }: HandPose): Pose => ({
  position: [x, y, z],
  axis: unit([a, b, c]),
});

/** The simulated hand as this page moves it: its target, m, and the direction of the needle. */
export class Hand {
  /** The target from this page; null while something else moves the hand. */
  readonly target = new Signal<Pose | null>(null);
  /** Why this page cannot move the hand, in words; null if it can. */
  readonly barred = new Signal<string | null>("Connecting to the studio.");

  /** The last run in which this page's person tried to move the needle, with or without control. */
  tried = -1;

  constructor(private readonly app: App) {
    const look = (): void => {
      this.barred.value = this.reason();
      if (this.barred.value) this.target.value = null;
    };
    app.hello.watch(look);
    let you = false;
    app.control.watch((control) => {
      look();
      // A page that gets control continues from the hand, which may be ahead of the needle in tissue.
      if (control.you && !you && control.hand && !this.barred.value) this.target.value = poseOf(control.hand);
      you = control.you;
    });
    app.connection.watch(look);
    app.source.watch(look);
    // A new run begins at the pose that the server chooses.
    app.run.watch(() => {
      this.target.value = null;
    });
    app.status.watch((status) => {
      if (status && (status.hand === "strokes" || status.hand === "motion") && !this.fresh) this.target.value = null;
    });
  }
  private touched = Number.NEGATIVE_INFINITY;
  /** A status message sent before this page moved the hand must not undo that. */
  private get fresh(): boolean {
    return performance.now() - this.touched < 600;
  }

  /** The number of the live run: keys and sticks held since an earlier run do not count. */
  get run(): number {
    return this.app.run.value;
  }

  private reason(): string | null {
    const { connection, hello, control, source, exercise } = this.app;
    if ((connection.value.state !== "open" || !hello.value) && !this.app.engine.studio)
      return "The core does not run in this page yet.";
    if (connection.value.state !== "open" || !hello.value)
      return goneWords(connection.value, exercise.value?.running ?? false);
    if (!hello.value.device.simulated) return `${hello.value.device.model} is the hand now: move its stylus.`;
    if (source.value.excerpt) return "A moment is shown again. Go back to the live run to move the needle.";
    if (source.value.paused) return "The page is paused. Go back to live to move the needle.";
    if (!source.value.live) return "A recording is shown. Go back to the live run to move the needle.";
    if (!control.value.you) return `${controlWords(this.app)}.`;
    return null;
  }

  /** The present target, or else the pose of the needle. */
  pose(): Pose | null {
    if (this.target.value) return this.target.value;
    const { history } = this.app.live;
    if (history.length === 0) return null;
    const tick = history.end - 1;
    const [x = 0, y = 0, z = 0] = history.row("position", tick);
    const axis = history.row("axis", tick);
    return { position: [x, y, z], axis: unit([axis[0] ?? 0, axis[1] ?? -1, axis[2] ?? 0]) };
  }

  /** The pose from which a drag starts; null if this page cannot move the hand. */
  grab(): Pose | null {
    this.tried = this.run;
    return this.barred.value ? null : this.pose();
  }

  moveTo(position: Triple, axis?: Triple): void {
    this.tried = this.run;
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

  /** Gives up the target: something else moves the hand now. */
  release(): void {
    this.touched = Number.NEGATIVE_INFINITY;
    this.target.value = null;
  }
  /** Makes the present pose of the needle the target. */
  hold(): void {
    this.release();
    const now = this.pose();
    if (now) this.moveTo(now.position, now.axis);
  }

  /** Moves along the needle, m; positive is inward. */
  push(depth: number): void {
    const now = this.pose();
    if (now) this.moveTo(add(now.position, scaled(now.axis, depth)));
  }

  moveBy(step: Triple): void {
    const now = this.pose();
    if (now) this.moveTo(add(now.position, step));
  }

  /** rad between the needle and the first membrane's inward normal, leaning along +x; 0 before the first tick. */
  tilt(): number {
    const now = this.pose();
    return now ? tiltOf(now.axis, this.normal()) : 0;
  }
  /**
   * In tissue the needle turns about its tip. In front of it, it aims at the middle of the scene and keeps its
   * height.
   */
  setTilt(angle: number): void {
    const now = this.pose();
    if (!now) return;
    const axis = tilted(Math.max(-LARGEST_TILT, Math.min(LARGEST_TILT, angle)), this.normal());
    const scene = this.app.live.scene.value;
    const before = scene ? heightOver(scene, now.position) : 0;
    this.moveTo(scene && before > 0 ? aiming(scene, axis, before) : now.position, axis);
  }

  /** Moves in front of the first membrane, `height` (m) away, aiming at the middle of the scene. */
  home(height = 0.005): void {
    const now = this.pose();
    const scene = this.app.live.scene.value;
    if (now && scene) this.moveTo(aiming(scene, now.axis, height));
  }

  normal(): Triple {
    return this.app.live.scene.value?.membranes[0]?.inward_normal ?? [0, -1, 0];
  }
  /** The direction in the first surface towards which the needle leans. */
  side(): Triple {
    return alongSkin(this.normal());
  }
  /** The direction in the first surface towards the viewer. */
  near(): Triple {
    return towardsViewer(this.normal());
  }
  /** The distance from the tip to the target, m; null without a target. */
  lag(): number | null {
    const { history } = this.app.live;
    if (!this.target.value || history.length === 0) return null;
    const [x = 0, y = 0, z = 0] = history.row("tip", history.end - 1);
    return length(sub(this.target.value.position, [x, y, z]));
  }
}

/** Why there is no connection, and what to do. */
function goneWords(now: Connection, attempt: boolean): string {
  if (now.state === "refused") return `${now.reason.replace(/\.$/, "")}. Open the address that the studio prints.`;
  const ended = `If its program has ended, ${attempt ? "the attempt is lost: " : ""}start the studio again`;
  const again = `${ended} and open the address that it prints; else this page connects by itself.`;
  const trying = now.state === "open" || (now.state === "connecting" && now.attempt <= 1);
  return trying ? "Connecting to the studio." : `The studio does not answer. ${again}`;
}

/** The hand of this page; there is one per app. */
export const handOf = onePerApp((app) => new Hand(app));

/** Distance in front of the first membrane, m; negative behind its front face. */
function heightOver(scene: SceneView, position: Triple): number {
  const first = scene.membranes[0];
  return first ? -dot(sub(position, first.point), first.inward_normal) : 0;
}

/**
 * The position of the tip, `height` (m) in front of the first membrane, from which `axis` points to the centre of all
 * membranes.
 */
function aiming(scene: SceneView, axis: Triple, height: number): Triple {
  const first = scene.membranes[0];
  if (!first) return scaled(axis, -height);
  const normal = first.inward_normal;
  const depths = scene.membranes.map(({ point, thickness }) => dot(sub(point, first.point), normal) + thickness);
  const half = Math.max(...depths) / 2;
  const slope = Math.max(0.1, dot(axis, normal));
  return add(add(first.point, scaled(normal, half)), scaled(axis, -(half + height) / slope));
}

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
