import { Vector3 } from "three";
import { MM } from "../scene/moment.ts";
import type { SkinFrame } from "../scene/probe.ts";
import { type Fill, layersOf, type Layer as Parallel } from "../tissue/layers.ts";
import type { SceneView } from "../wire/messages.ts";

/** A layer of undeformed tissue: its depth is from + normal . (place - origin of the skin), mm. */
export interface Layer {
  readonly fill: Fill;
  readonly normal: Vector3;
  readonly from: number;
  readonly thickness: number;
}

/** The lumen of a vessel, in the undeformed tissue, mm. */
interface Vessel {
  readonly depth: number;
  readonly radius: number;
  readonly wall: number;
  readonly wallFill: Fill;
}

/** The undeformed tissue, as the slice draws it. */
export interface Tissue {
  readonly layers: readonly Layer[];
  /** The same with all membranes parallel to the first one, for the dents. */
  readonly parallel: readonly Parallel[];
  readonly vessel: Vessel | null;
  /** What lies beside a vessel, and below the last layer. */
  readonly beside: Fill;
  readonly below: Fill;
  /** Depth of the last membrane's far face. */
  readonly deep: number;
}

export function tissueOf(scene: SceneView, skin: SkinFrame): Tissue {
  const parallel = parallelLayers(scene);
  const vessel = vesselOf(scene, parallel);
  const front = parallel.findIndex(({ membrane }) => membrane !== null && membrane === scene.lumen[0]);
  const shown = parallel.filter(
    ({ membrane, fill }) => !vessel || (fill !== "blood" && (membrane === null || !scene.lumen.includes(membrane))),
  );
  return {
    layers: shown.map((layer) => placed(layer, scene, skin)),
    parallel,
    vessel,
    beside: parallel.slice(0, Math.max(0, front)).findLast(({ membrane }) => membrane === null)?.fill ?? "tissue",
    below: parallel.at(-1)?.fill ?? "tissue",
    deep: Math.max(0, ...parallel.filter(({ membrane }) => membrane !== null).map(({ bottom }) => bottom)),
  };
}

/** The layers from the surface down, with tilted membranes turned parallel, and each with its own look. */
function parallelLayers(scene: SceneView): Parallel[] {
  const normal = scene.membranes[0]?.inward_normal ?? [0, -1, 0];
  // Membranes of glass are sheets in the 3-D view; the slice shows them as layers, too.
  const membranes = scene.membranes.map((m) => ({ ...m, inward_normal: normal, look: "fascia" as const }));
  const layers = layersOf({ membranes }) ?? [];
  return layers.map((layer) =>
    layer.membrane === null ? layer : { ...layer, fill: scene.membranes[layer.membrane]!.look },
  );
}

function placed(layer: Parallel, scene: SceneView, skin: SkinFrame): Layer {
  const thickness = layer.bottom - layer.top;
  const membrane = layer.membrane === null ? null : scene.membranes[layer.membrane]!;
  if (!membrane) return { fill: layer.fill, normal: skin.inward.clone(), from: -layer.top, thickness };
  const normal = new Vector3(...membrane.inward_normal).normalize();
  const point = new Vector3(...membrane.point).multiplyScalar(MM);
  return { fill: layer.fill, normal, from: normal.dot(skin.origin.clone().sub(point)), thickness };
}

/** The walls of a lumen bound a tube. The model's walls are planes; the needle meets both where they touch the tube. */
function vesselOf({ lumen }: SceneView, layers: readonly Parallel[]): Vessel | null {
  const [front, back] = lumen.map((wall) => layers.find(({ membrane }) => membrane === wall));
  if (!front || !back || back.top <= front.bottom) return null;
  const radius = (back.top - front.bottom) / 2;
  return { depth: front.bottom + radius, radius, wall: front.bottom - front.top, wallFill: front.fill };
}

/** The picture's depth, mm: the last layer and a little more, in steps of 5 mm. */
export const pictureDepth = ({ deep }: Tissue): number => Math.max(10, 5 * Math.ceil((1.2 * deep + 2) / 5));
