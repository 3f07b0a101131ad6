import type { Fill } from "../tissue/layers.ts";

/**
 * The look of a tissue in the slice, on a scale of grey from 0 to 255. Illustrative: chosen by eye, not measured.
 * level: mean grey; grain: strength of the speckle; line: brightness of its fibres or septa; perMm: fibres per mm of
 * depth; wave: their waviness, in fibres; thin: how thin they are against their distance.
 */
export interface Texture {
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
