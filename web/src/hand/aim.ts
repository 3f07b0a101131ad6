import type { Triple } from "../engine/engine.ts";
import type { SceneView } from "../wire/messages.ts";
import { add, dot, scaled, sub } from "./vectors.ts";

/** Distance in front of the first membrane, m; negative behind its front face. */
export function heightOver(scene: SceneView, position: Triple): number {
  const first = scene.membranes[0];
  return first ? -dot(sub(position, first.point), first.inward_normal) : 0;
}

/**
 * The position of the tip, `height` (m) in front of the first membrane, from which `axis` points to the centre of all
 * membranes.
 */
export function aiming(scene: SceneView, axis: Triple, height: number): Triple {
  const first = scene.membranes[0];
  if (!first) return scaled(axis, -height);
  const normal = first.inward_normal;
  const depths = scene.membranes.map(({ point, thickness }) => dot(sub(point, first.point), normal) + thickness);
  const half = Math.max(...depths) / 2;
  const slope = Math.max(0.1, dot(axis, normal));
  return add(add(first.point, scaled(normal, half)), scaled(axis, -(half + height) / slope));
}
