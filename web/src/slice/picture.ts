import type { SkinFrame, SlicePlane } from "../scene/probe.ts";
import type { Dents } from "./dents.ts";
import type { Tissue } from "./layers.ts";
import type { NeedleSpan } from "./needle_span.ts";
import { ACROSS, ACROSS_PER_MM, DEEP, DEEP_PER_MM, speckle } from "./speckle.ts";
import { directed, strataOf, TEXTURES } from "./strata.ts";

const FADE = 46; // loss of brightness from the skin to the bottom
const FAR = 30; // square of a distance, in widths of the dent, at which nothing is displaced
const SHADOW = 0.58; // brightness behind the needle
const ENHANCED = 24; // brightness behind a vein: blood takes little of the sound

/** The size of a picture, in pixels and mm. */
export interface Raster {
  readonly columns: number;
  readonly rows: number;
  readonly width: number;
  readonly depth: number;
}

/**
 * Draws the tissue into `out`, one grey value as 32 bits for each pixel. Each pixel takes its texture from the place of
 * the undeformed tissue that the needle has displaced to it, so the speckle moves with the tissue.
 */
export function paintTissue(
  out: Uint32Array,
  raster: Raster,
  plane: SlicePlane,
  skin: SkinFrame,
  tissue: Tissue,
  dents: Dents,
  shadow: Float32Array,
): void {
  const { columns, rows, width, depth } = raster;
  const grains = speckle();
  const from = plane.origin.clone().sub(skin.origin);
  const start = { p: from.dot(skin.right), q: from.dot(skin.front) };
  const perAlong = { p: plane.along.dot(skin.right), q: plane.along.dot(skin.front) };
  const { cut, track, along, down, step, needle } = dents;
  // From the skin's directions to those of the cut, which contains the needle.
  const [uOfP, uOfQ] = [cut.along.dot(skin.right), cut.along.dot(skin.front)];
  const [wOfP, wOfQ] = [cut.towards.dot(skin.right), cut.towards.dot(skin.front)];
  const { vessel } = tissue;
  const [beside, below] = [TEXTURES[tissue.beside], TEXTURES[tissue.below]];
  const wall = TEXTURES[vessel?.wallFill ?? "plain"];
  const dented = dents.most > 0;
  const sharp = 1 / dents.reach ** 2;
  const last = down.length - 1;
  const [wide, tall] = [ACROSS - 1, DEEP - 1];
  const stepAcross = width / columns;
  const stepDown = depth / rows;
  const strata = strataOf(directed(tissue.layers, skin), depth, 0.7 * stepDown);
  const thinnest = Math.max(vessel?.wall ?? 0, stepDown);
  // The waves of the fibres change little from place to place: one value a column.
  const waves = new Float32Array(2 * columns);
  for (let column = 0; column < columns; column++) {
    const a = (column + 0.5) * stepAcross - width / 2;
    const q = start.q + a * perAlong.q;
    waves[2 * column] = Math.sin(0.55 * (start.p + a * perAlong.p) + 0.21 * q);
    waves[2 * column + 1] = 0.4 * Math.sin(0.37 * q);
  }
  for (let row = 0; row < rows; row++) {
    const d0 = (row + 0.5) * stepDown;
    const fade = (FADE * d0) / depth - (d0 < 0.5 ? 60 * (1 - 2 * d0) : 0);
    for (let column = 0; column < columns; column++) {
      const a = (column + 0.5) * stepAcross - width / 2;
      let p = start.p + a * perAlong.p;
      let q = start.q + a * perAlong.q;
      let d = d0;
      const w = p * wOfP + q * wOfQ;
      if (dented) {
        const u = p * uOfP + q * uOfQ;
        const aside = (w - needle) ** 2 * sharp;
        let i = Math.min(last, Math.round(d / step));
        if (aside + (u - track[i]!) ** 2 * sharp < FAR) {
          // The undeformed depth is found in steps: each takes the displacement at the last depth found.
          let part = 0;
          for (let turn = 0; turn < 3; turn++) {
            const near = 1 + aside + (u - track[i]! - along[i]!) ** 2 * sharp;
            part = 1 / (near * Math.sqrt(near));
            d = d0 - part * down[i]!;
            i = d <= 0 ? 0 : Math.min(last, Math.round(d / step));
          }
          p -= part * along[i]! * uOfP;
          q -= part * along[i]! * uOfQ;
        }
      }
      let texture = strata.find(p, q, d) ?? (d > tissue.deep ? below : beside);
      let edge = strata.edge;
      if (vessel) {
        const under = d - vessel.depth;
        const across = w - cut.w;
        const away = Math.sqrt(across * across + under * under) - vessel.radius;
        if (away < 0) {
          texture = TEXTURES.blood;
          edge = 0;
        } else if (away < thinnest) texture = wall;
        else if (under > 0 && Math.abs(across) < vessel.radius) edge += ENHANCED;
      }
      // Two parts of the block at different scales, so that its period does not show.
      const x = p * ACROSS_PER_MM;
      const y = q * ACROSS_PER_MM;
      const z = d * DEEP_PER_MM;
      const near = (((x & wide) * ACROSS + (y & wide)) * DEEP + (z & tall)) | 0;
      const other =
        ((((0.62 * x + 19) & wide) * ACROSS + ((0.62 * y + 7) & wide)) * DEEP + ((0.71 * z + 40) & tall)) | 0;
      const grain = 0.65 * grains[near]! + 0.35 * grains[other]! - 128;
      let grey = texture.level + texture.grain * grain + edge - fade;
      if (texture.line > 0) {
        const phase = d * texture.perMm + texture.wave * waves[2 * column]! + waves[2 * column + 1]!;
        const line = 1 - Math.abs(phase - Math.floor(phase) - 0.5) * 2 * texture.thin;
        if (line > 0) grey += texture.line * line * (0.6 + grain / 128);
      }
      if (d0 > shadow[column]!) grey *= SHADOW;
      const level = grey < 0 ? 0 : grey > 255 ? 255 : grey | 0;
      out[row * columns + column] = 0xff000000 | (level << 16) | (level << 8) | level;
    }
  }
}

/** The depth in each column below which the needle's shadow begins, mm; infinite without a shadow. */
export function shadowOf(span: NeedleSpan | null, radius: number, raster: Raster, shadow: Float32Array): void {
  shadow.fill(Number.POSITIVE_INFINITY);
  if (!span || span.off > 0.8) return;
  const { deep, shallow } = span;
  const step = raster.width / raster.columns;
  const [left, right] = deep.along < shallow.along ? [deep, shallow] : [shallow, deep];
  const at = (along: number): number => (along + raster.width / 2) / step - 0.5;
  const first = Math.max(0, Math.ceil(at(left.along - radius)));
  const last = Math.min(raster.columns - 1, Math.floor(at(right.along + radius)));
  for (let column = first; column <= last; column++) {
    const along = (column + 0.5) * step - raster.width / 2;
    const part = (along - left.along) / Math.max(1e-6, right.along - left.along);
    const share = Math.min(1, Math.max(0, part));
    shadow[column] = left.depth + share * (right.depth - left.depth) + radius;
  }
}
