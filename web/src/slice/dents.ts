import { Vector3 } from "three";
import { BARRED, type Moment, OUTSIDE } from "../scene/moment.ts";
import type { SlicePlane } from "../scene/probe.ts";

/** Displacement of the tissue at the needle by depth, and the needle that causes it, in the picture's directions. */
export interface Dents {
  /** Along the picture, out of it and into the depth, mm: three numbers for each row of the picture. */
  readonly rows: Float32Array;
  /** Width of the dent, mm. */
  readonly width: number;
  /** Place of the tip and direction of the needle: along, out, deep. */
  readonly tip: readonly [number, number, number];
  readonly axis: readonly [number, number, number];
  /** The largest displacement, mm. */
  readonly most: number;
}

/** A place in front of or behind a membrane with its displacement. */
interface Knot {
  /** Depth of the displaced place, mm. */
  depth: number;
  readonly shift: Vector3;
}

const SMALLEST = 0.01;

/** Membranes as the dents need them, mm. */
export interface Dented {
  readonly front: number;
  readonly thickness: number;
  readonly normal: Vector3;
}

/**
 * The dents of a moment. Each membrane that holds the needle is displaced by the way from its proxy to the tip,
 * K06 (21); between membranes the displacement changes evenly, and ahead of the last one it decays.
 */
export function dentsOf(
  moment: Moment,
  membranes: readonly Dented[],
  plane: SlicePlane,
  diameter: number,
  rowCount: number,
  rowHeight: number,
): Dents {
  const width = 1.6 * diameter + 0.8;
  const knots = knotsOf(moment, membranes, plane.inward, width);
  const from = moment.tip.clone().sub(plane.origin);
  const split = (v: Vector3): [number, number, number] => [
    v.dot(plane.along), v.dot(plane.out), v.dot(plane.inward),
  ]; // biome-ignore format: one line
  const rows = new Float32Array(3 * rowCount);
  const shift = new Vector3();
  for (let row = 0; row < rowCount && knots.length > 0; row++) {
    displacementAt(knots, (row + 0.5) * rowHeight, width, shift);
    rows.set(split(shift), 3 * row);
  }
  const most = Math.max(0, ...knots.map((knot) => knot.shift.length()));
  return { rows, width, tip: split(from), axis: split(moment.axis), most };
}

export function knotsOf(moment: Moment, membranes: readonly Dented[], inward: Vector3, width: number): Knot[] {
  const knots: Knot[] = [];
  membranes.forEach(({ front, thickness, normal }, i) => {
    const state = moment.membranes[i];
    if (!state || state.phase === OUTSIDE || state.phase === BARRED || state.direction.lengthSq() < 0.5) return;
    const lead = moment.tip.clone().sub(state.proxy);
    if (lead.length() < SMALLEST) lead.set(0, 0, 0);
    const path = thickness / Math.max(0.1, state.direction.dot(normal));
    // The far face gives way before the tip reaches it.
    const part = state.depth > path ? 1 : Math.exp((state.depth - path) / width);
    const far = lead.clone().multiplyScalar(part);
    knots.push({ depth: front + lead.dot(inward), shift: lead });
    knots.push({ depth: front + thickness + far.dot(inward), shift: far });
  });
  return knots.sort((a, b) => a.depth - b.depth);
}

/** The displacement at a depth, mm, at the needle. */
export function displacementAt(knots: readonly Knot[], depth: number, width: number, shift: Vector3): Vector3 {
  const next = knots.findIndex((knot) => knot.depth > depth);
  const last = knots.at(-1);
  if (!last) return shift.set(0, 0, 0);
  if (next === 0) return shift.copy(knots[0]!.shift);
  if (next < 0) return shift.copy(last.shift).multiplyScalar(Math.exp((last.depth - depth) / width));
  const [above, below] = [knots[next - 1]!, knots[next]!];
  const part = (depth - above.depth) / Math.max(1e-6, below.depth - above.depth);
  return shift.lerpVectors(above.shift, below.shift, part);
}
