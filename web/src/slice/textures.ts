import type { SceneView } from "../wire/messages.ts";

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

export const TEXTURES = {
  skin: { level: 150, grain: 0.7, line: 24, perMm: 2.4, wave: 0.1, thin: 2 },
  fat: { level: 58, grain: 0.7, line: 92, perMm: 0.34, wave: 0.5, thin: 6 },
  muscle: { level: 72, grain: 0.75, line: 52, perMm: 0.75, wave: 0.25, thin: 3 },
  ligament: { level: 122, grain: 0.6, line: 42, perMm: 1.5, wave: 0.12, thin: 2 },
  tissue: { level: 74, grain: 0.8, line: 60, perMm: 0.42, wave: 0.45, thin: 5 },
  wall: plain(165, 0.5),
  dura: plain(215, 0.4),
  blood: plain(10, 0.3),
  fluid: plain(8, 0.25),
} as const satisfies Record<string, Texture>;

export type TextureName = keyof typeof TEXTURES;

/** The texture of each membrane, from its thickness and its place: a scene file does not say more. */
export function membraneTextures(scene: SceneView): TextureName[] {
  return scene.membranes.map(({ thickness }, i) => {
    if (scene.lumen.includes(i)) return "wall";
    if (i === 0) return "skin";
    if (thickness < 0.6e-3) return "dura";
    return thickness > 8e-3 ? "fat" : "ligament";
  });
}
