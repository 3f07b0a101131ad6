import type { Layer } from "./layers.ts";
import { TEXTURES, type Texture } from "./textures.ts";

const FACE_MM = 0.16; // thickness of the bright echo at a layer's face
const FACE = 70;
const STEP = 0.05; // mm between two entries of the table
const TILTED = 0.9999;

/** Finds the texture at a place of the undeformed tissue, and the brightness of the faces near it. */
export interface Strata {
  /** p, q: along the skin's right and front; d: depth, mm. Returns null outside all layers. */
  find(p: number, q: number, d: number): Texture | null;
  /** Of the last place found. */
  edge: number;
}

/** The layers in the skin's directions: right, front, deep. */
export interface Directed extends Pick<Layer, "from" | "thickness"> {
  readonly texture: Texture;
  readonly right: number;
  readonly front: number;
  readonly deep: number;
}

/** blur: the least thickness of a face, mm. Layers parallel to the skin are looked up in a table by depth. */
export function strataOf(layers: readonly Directed[], depth: number, blur: number): Strata {
  const slow = search(layers, Math.max(FACE_MM, blur));
  if (layers.some(({ deep }) => deep < TILTED)) return slow;
  const count = Math.ceil((depth + 10) / STEP) + 1;
  const textures = new Array<Texture | null>(count).fill(null);
  const edges = new Float32Array(count);
  for (let i = 0; i < count; i++) {
    textures[i] = slow.find(0, 0, i * STEP);
    edges[i] = slow.edge;
  }
  const table: Strata = {
    edge: 0,
    find(_p, _q, d) {
      const i = d <= 0 ? 0 : Math.min(count - 1, Math.round(d / STEP));
      table.edge = edges[i]!;
      return textures[i]!;
    },
  };
  return table;
}

function search(layers: readonly Directed[], blur: number): Strata {
  const made: Strata = {
    edge: 0,
    find(p, q, d) {
      let texture: Texture | null = null;
      made.edge = 0;
      for (const layer of layers) {
        const s = layer.from + p * layer.right + q * layer.front + d * layer.deep;
        if (s >= 0 && s <= layer.thickness) texture = layer.texture;
        const face = Math.min(Math.abs(s), Math.abs(s - layer.thickness));
        if (face < blur) made.edge = Math.max(made.edge, FACE * (1 - face / blur) * Math.abs(layer.deep));
      }
      return texture;
    },
  };
  return made;
}

/** The layers, with their normals split into the skin's directions. */
export const directed = (
  layers: readonly Layer[],
  { right, front, inward }: { right: Layer["normal"]; front: Layer["normal"]; inward: Layer["normal"] },
): Directed[] =>
  layers.map(({ fill, normal, from, thickness }) => ({
    texture: TEXTURES[fill], from, thickness,
    right: normal.dot(right), front: normal.dot(front), deep: normal.dot(inward),
  })); // biome-ignore format: short
