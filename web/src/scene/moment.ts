import { Vector3 } from "three";
import { scaleOf } from "../state/scale.ts";
import type { Source } from "../state/source.ts";
import { codeOf } from "../wire/ticks.ts";

/** mm per m. The view is drawn in mm, which suits the precision of a graphics card. */
export const MM = 1000;
const SPEED_TICKS = 40; // 25 ms at 1600 Hz
export const OUTSIDE = codeOf("phase", "outside");
export const BARRED = codeOf("phase", "barred");

export interface MembraneMoment {
  phase: number;
  /** Depth behind the front face, along the needle, mm. */
  depth: number;
  /** The proxy: the point of the undeformed tissue that the tip is at, mm. */
  readonly proxy: Vector3;
  /** Entry direction b; (0, 0, 0) outside. */
  readonly direction: Vector3;
}

/** The values of one tick that the view draws. Lengths in mm, forces in N. */
export class Moment {
  tick = -1;
  time = 0;
  state = 0;
  readonly tip = new Vector3();
  readonly axis = new Vector3(0, -1, 0);
  readonly force = new Vector3();
  readonly modelForce = new Vector3();
  /** How much of the model's force the device gives, before the limits. */
  scale = 1;
  /** Depth of the syringe's plunger, mm; NaN if the scene has no syringe. */
  plunger = Number.NaN;
  /** Speed of the plunger, mm/s, and force of the thumb on it, N; NaN if the scene has no syringe. */
  plungerSpeed = Number.NaN;
  thumbForce = Number.NaN;
  membranes: MembraneMoment[] = [];

  /** Reads a tick of the source, by default the shown one. Returns false before its first tick. */
  read(source: Source, tick = source.shown()): boolean {
    if (tick === null) return false;
    const { history } = source;
    this.tick = tick;
    this.time = history.timeOf(tick);
    this.state = history.byteRow("state", tick)[0] ?? 0;
    this.tip.fromArray(history.row("tip", tick)).multiplyScalar(MM);
    this.axis.fromArray(history.row("axis", tick));
    if (this.axis.lengthSq() < 0.5 || Number.isNaN(this.axis.x)) this.axis.set(0, -1, 0);
    this.axis.normalize();
    this.force.fromArray(history.row("force", tick));
    this.modelForce.fromArray(history.row("model_force", tick));
    this.scale = scaleOf(source, tick);
    this.plunger = (history.row("plunger", tick)[0] ?? Number.NaN) * MM;
    const from = Math.max(history.first, tick - SPEED_TICKS);
    const before = (history.row("plunger", from)[0] ?? Number.NaN) * MM;
    this.plungerSpeed = from < tick ? (this.plunger - before) / (this.time - history.timeOf(from)) : 0;
    this.thumbForce = Math.abs(history.row("thumb_force", tick)[0] ?? Number.NaN);
    this.readMembranes(source, tick);
    return Number.isFinite(this.tip.x + this.tip.y + this.tip.z);
  }

  private readMembranes({ history }: Source, tick: number): void {
    const count = history.membranes;
    while (this.membranes.length < count) {
      this.membranes.push({ phase: OUTSIDE, depth: 0, proxy: new Vector3(), direction: new Vector3() });
    }
    this.membranes.length = count;
    const phase = history.byteRow("phase", tick);
    const depth = history.row("depth", tick);
    const proxy = history.row("proxy", tick);
    const direction = history.row("direction", tick);
    this.membranes.forEach((membrane, i) => {
      membrane.phase = phase[i] ?? OUTSIDE;
      membrane.depth = (depth[i] ?? 0) * MM || 0;
      membrane.proxy.fromArray(proxy, 3 * i).multiplyScalar(MM);
      membrane.direction.fromArray(direction, 3 * i);
      if (!Number.isFinite(membrane.direction.x)) membrane.direction.set(0, 0, 0);
    });
  }
}
