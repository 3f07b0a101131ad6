import type { Camera, Vector3 } from "three";

const EDGE = 0.94; // of the view's half size: a point nearer to the border counts as out of view

/** Whether a point is outside the view. mm. */
export function outOfView(point: Vector3, camera: Camera): boolean {
  const { x, y, z } = point.clone().project(camera);
  return Math.abs(x) > EDGE || Math.abs(y) > EDGE || z > 1;
}
