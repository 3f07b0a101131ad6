import type { Fill } from "../tissue/layers.ts";
import type { Layer } from "./layers.ts";

/**
 * The look of a tissue in the slice, on a scale of grey from 0 to 255. Illustrative: chosen by eye, not measured.
 * level: mean grey; grain: strength of the speckle; line: brightness of its fibres or septa; perMm: fibres per mm of
 * depth; wave: their waviness, in fibres; thin: how thin they are against their distance.
 */
interface Texture {
  readonly level: number;
  readonly grain: number;
  readonly line: number;
  readonly perMm: number;
  readonly wave: number;
  readonly thin: number;
}

const plain = (level: number, grain: number): Texture => ({ level, grain, line: 0, perMm: 0, wave: 0, thin: 1 });
const ligament: Texture = { level: 118, grain: 0.6, line: 44, perMm: 1.3, wave: 0.16, thin: 2 };

export const TEXTURES: Readonly<Record<Fill, Texture>> = {
  plain: plain(120, 0.6),
  skin: { level: 150, grain: 0.7, line: 24, perMm: 2.4, wave: 0.1, thin: 2 },
  fat: { level: 56, grain: 0.7, line: 92, perMm: 0.34, wave: 0.5, thin: 6 },
  muscle: { level: 70, grain: 0.75, line: 54, perMm: 0.75, wave: 0.25, thin: 3 },
  fascia: plain(190, 0.5),
  ligament,
  "ligamentum flavum": { ...ligament, level: 156, line: 30, perMm: 2 },
  dura: plain(220, 0.4),
  "vein wall": plain(165, 0.5),
  "artery wall": plain(195, 0.45),
  tissue: { level: 74, grain: 0.8, line: 60, perMm: 0.42, wave: 0.45, thin: 5 },
  blood: plain(10, 0.3),
  "epidural space": { level: 44, grain: 0.6, line: 60, perMm: 0.5, wave: 0.6, thin: 6 },
  "cerebrospinal fluid": plain(8, 0.25),
};

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
