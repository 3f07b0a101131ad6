import type { Camera, Vector3 } from "three";

const EDGE = 0.94; // of the view's half size: a point nearer to the border counts as out of view

/** Whether a point (mm) is outside the view, or under its toolbar. covered: share of the height under the toolbar. */
export function outOfView(point: Vector3, camera: Camera, covered = 0): boolean {
  const { x, y, z } = point.clone().project(camera);
  return Math.abs(x) > EDGE || y < -EDGE || y > EDGE - 2 * covered || z > 1;
}
