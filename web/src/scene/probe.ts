import { Vector3 } from "three";
import { onePerApp } from "../state/app.ts";
import { Signal } from "../state/signal.ts";
import type { MembraneView, SceneView } from "../wire/messages.ts";
import { MM } from "./moment.ts";
import { tangents } from "./slab_shape.ts";

/** The place of the slice's probe on the skin: mm from the first membrane's point, and its turn in radians. */
export interface ProbePlace {
  readonly x: number;
  readonly z: number;
  readonly turn: number;
}

/** The slice's plane: the middle of the probe, the direction along the picture, into the depth, and out of it. mm. */
export interface SlicePlane {
  readonly origin: Vector3;
  readonly along: Vector3;
  readonly inward: Vector3;
  readonly out: Vector3;
}

/** The skin's plane: a point, the inward normal, and two directions that span it. The first points right. */
export interface SkinFrame {
  readonly origin: Vector3;
  readonly inward: Vector3;
  readonly right: Vector3;
  readonly front: Vector3;
}

/** The probe's place, and the size of its picture while it is open (mm). Slice and 3-D view share it. */
export class Probe {
  readonly place = new Signal<ProbePlace>({ x: 0, z: 0, turn: 0 });
  readonly picture = new Signal<{ readonly width: number; readonly depth: number } | null>(null);
}

/** The app's probe. */
export const probeOf = onePerApp(() => new Probe());

export function skinFrame(scene: SceneView): SkinFrame {
  const first = topMembrane(scene);
  const origin = new Vector3(...(first?.point ?? [0, 0, 0])).multiplyScalar(MM);
  const inward = new Vector3(...(first?.inward_normal ?? [0, -1, 0])).normalize();
  const right = new Vector3();
  const front = new Vector3();
  tangents(inward, right, front);
  return { origin, inward, right, front };
}

/** The membrane that is met first; the file may list them in another order. */
function topMembrane({ membranes }: SceneView): MembraneView | undefined {
  const normal = membranes[0]?.inward_normal ?? [0, -1, 0];
  const depth = ({ point }: MembraneView): number => point.reduce((sum, x, axis) => sum + x * normal[axis]!, 0);
  return membranes.reduce<MembraneView | undefined>((a, b) => (a && depth(a) <= depth(b) ? a : b), undefined);
}

export function planeOf(skin: SkinFrame, { x, z, turn }: ProbePlace): SlicePlane {
  const origin = skin.origin.clone().addScaledVector(skin.right, x).addScaledVector(skin.front, z);
  const along = skin.right.clone().multiplyScalar(Math.cos(turn)).addScaledVector(skin.front, Math.sin(turn));
  return { origin, along, inward: skin.inward.clone(), out: new Vector3().crossVectors(skin.inward, along) };
}

/**
 * The place from which the picture contains the needle, with its middle `ahead` of the tip (mm); `across` turns the
 * picture by 90 degrees about the tip.
 */
export function placeAtNeedle(
  skin: SkinFrame,
  tip: Vector3,
  axis: Vector3,
  across: boolean,
  before: ProbePlace,
  ahead = 0,
): ProbePlace {
  const from = new Vector3().subVectors(tip, skin.origin);
  const [right, front] = [axis.dot(skin.right), axis.dot(skin.front)];
  // An upright needle has no direction on the skin.
  const upright = Math.hypot(right, front) < 0.05;
  const inPlane = upright ? before.turn : Math.atan2(front, right);
  const turn = across ? (upright ? before.turn : inPlane) + Math.PI / 2 : inPlane;
  const on = across || upright ? 0 : ahead / Math.hypot(right, front);
  return { x: from.dot(skin.right) + on * right, z: from.dot(skin.front) + on * front, turn: wrapped(turn) };
}

/** The same picture's angle, from -90 to 90 degrees: a turn by 180 degrees only mirrors the picture. */
export const wrapped = (turn: number): number => turn - Math.PI * Math.round(turn / Math.PI);
