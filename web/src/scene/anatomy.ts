import { Vector3 } from "three";
import { layersOf } from "../tissue/layers.ts";
import type { SceneView } from "../wire/messages.ts";
import { MM } from "./moment.ts";
import { tangents } from "./slab_shape.ts";

/** Drawn sizes that the scene does not define, mm. */
export interface Extent {
  /** Distance from the first front face to the last back face. */
  readonly deep: number;
  /** Half the side length of a slab. */
  readonly size: number;
  /** Length of the needle up to its hub. */
  readonly length: number;
  readonly centre: Vector3;
  readonly radius: number;
  /** Scale of the force arrow: the largest insertion friction of all laws fills half the view's radius. */
  readonly mmPerNewton: number;
}

/** A point of the skin, mm, and the direction into it. */
export function surfaceOf({ membranes: [first] }: SceneView): { point: Vector3; normal: Vector3 } {
  return {
    point: new Vector3(...(first?.point ?? [0, 0, 0])).multiplyScalar(MM),
    normal: new Vector3(...(first?.inward_normal ?? [0, -1, 0])),
  };
}

export function extentOf(scene: SceneView): Extent {
  const { point: origin, normal } = surfaceOf(scene);
  let deep = 0;
  for (const { point, thickness } of scene.membranes) {
    const front = new Vector3(...point).multiplyScalar(MM).sub(origin).dot(normal);
    deep = Math.max(deep, front + thickness * MM);
  }
  const tip = scene.tip_length * MM;
  const size = Math.min(24, Math.max(6 + 0.9 * deep, 1.9 * tip));
  const length = deep + 2 * tip + 12;
  const above = Math.min(14, 7 + 0.4 * deep);
  const layers = layersOf(scene);
  const below = layers ? layers.at(-1)!.bottom + 0.12 * size : deep + 0.5 * tip;
  const radius = Math.hypot((above + below) / 2, 1.12 * size);
  const centre = origin.clone().addScaledVector(normal, (below - above) / 2);
  // A block is drawn left of the middle: its names need the room on the right, and are longer than those of sheets.
  const right = new Vector3();
  tangents(normal, right, new Vector3());
  if (layers) centre.addScaledVector(right, 0.17 * size);
  const strongest = Math.max(0.2, ...scene.laws.flatMap((law) => law.lower.map(Math.abs)));
  return { deep, size, length, centre, radius, mmPerNewton: (0.5 * radius) / strongest };
}
