import type { Triple } from "../engine/engine.ts";

export const add = (a: Triple, b: Triple): Triple => [a[0] + b[0], a[1] + b[1], a[2] + b[2]];
export const sub = (a: Triple, b: Triple): Triple => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
export const scaled = (a: Triple, factor: number): Triple => [a[0] * factor, a[1] * factor, a[2] * factor];
export const dot = (a: Triple, b: Triple): number => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
export const length = (a: Triple): number => Math.hypot(...a);
export const unit = (a: Triple): Triple => {
  const size = length(a);
  return size > 0 ? scaled(a, 1 / size) : [0, -1, 0];
};

/** The unit vector in the plane with this normal that is closest to the right (+x). */
export function alongSkin(normal: Triple): Triple {
  const right: Triple = Math.abs(normal[0]) > 0.9 ? [0, 0, 1] : [1, 0, 0];
  return unit(sub(right, scaled(normal, dot(right, normal))));
}

/** The unit vector in the plane with this normal, at a right angle to alongSkin: towards the viewer (+z). */
export function towardsViewer(normal: Triple): Triple {
  const [a, b, c] = alongSkin(normal);
  const [x, y, z] = unit(normal);
  return [y * c - z * b, z * a - x * c, x * b - y * a];
}

/** The direction at `angle` (rad) from the inward normal, leaning towards alongSkin. */
export function tilted(angle: number, normal: Triple): Triple {
  return add(scaled(normal, Math.cos(angle)), scaled(alongSkin(normal), Math.sin(angle)));
}

/** The angle for which `tilted` is closest to the axis, rad. */
export const tiltOf = (axis: Triple, normal: Triple): number =>
  Math.atan2(dot(axis, alongSkin(normal)), dot(axis, normal));
