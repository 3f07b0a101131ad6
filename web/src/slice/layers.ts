import { Vector3 } from "three";
import { MM } from "../scene/moment.ts";
import type { SkinFrame } from "../scene/probe.ts";
import type { SceneView } from "../wire/messages.ts";
import { membraneTextures, TEXTURES, type Texture } from "./textures.ts";

/** A layer of undeformed tissue: depth = from + normal . (point - origin of the skin), mm. */
export interface Layer {
  readonly name: string;
  readonly texture: Texture;
  readonly normal: Vector3;
  readonly from: number;
  readonly thickness: number;
}

/** A vein along the skin's right, in the undeformed tissue, mm. */
export interface Vein {
  readonly depth: number;
  readonly radius: number;
  readonly wall: number;
}

/** The undeformed tissue, as the slice draws it. */
export interface Tissue {
  readonly layers: readonly Layer[];
  readonly vein: Vein | null;
  /** The texture where no membrane is. */
  readonly between: Texture;
  /** The texture behind the last membrane. */
  readonly behind: Texture;
  /** Depth of the last far face. */
  readonly deep: number;
}

export function tissueOf(scene: SceneView, skin: SkinFrame): Tissue {
  const textures = membraneTextures(scene);
  const all = scene.membranes.map((membrane, i): Layer => {
    const normal = new Vector3(...membrane.inward_normal).normalize();
    const point = new Vector3(...membrane.point).multiplyScalar(MM);
    const from = normal.dot(skin.origin.clone().sub(point));
    const texture = TEXTURES[textures[i]!];
    return { name: membrane.name, texture, normal, from, thickness: membrane.thickness * MM };
  });
  const deep = Math.max(0, ...all.map((layer) => layer.thickness - layer.from));
  const dura = textures.at(-1) === "dura";
  const vein = veinOf(all, scene.lumen);
  return {
    layers: vein ? all.filter((_, i) => !scene.lumen.includes(i)) : all,
    vein,
    between: TEXTURES.tissue,
    behind: dura ? TEXTURES.fluid : TEXTURES.muscle,
    deep,
  };
}

/** The two walls of a lumen bound a tube. The model's walls are planes; the needle meets both where they touch it. */
function veinOf(layers: readonly Layer[], lumen: readonly number[]): Vein | null {
  const [front, back] = [layers[lumen[0] ?? -1], layers[lumen[1] ?? -1]];
  if (!front || !back) return null;
  const top = front.thickness - front.from;
  const radius = (-back.from - top) / 2;
  return radius > 0 ? { depth: top + radius, radius, wall: front.thickness } : null;
}

/** The picture's depth, mm: the last layer and a quarter more, in steps of 5 mm. */
export const pictureDepth = ({ deep }: Tissue): number => Math.max(10, 5 * Math.ceil((1.2 * deep + 2) / 5));
