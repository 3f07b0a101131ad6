import type { SkinFrame, SlicePlane } from "../scene/probe.ts";
import type { Dents } from "./dents.ts";
import type { Tissue } from "./layers.ts";
import type { NeedleSpan } from "./needle_span.ts";
import { ACROSS_PER_MM, DEEP_PER_MM, speckle, voxel } from "./speckle.ts";
import { TEXTURES, type Texture } from "./textures.ts";

const FACE_MM = 0.16; // thickness of the bright echo at a layer's face
const FACE = 70;
const FADE = 46; // loss of brightness from the skin to the bottom
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
  const [p0, q0] = [from.dot(skin.right), from.dot(skin.front)];
  const [pAlong, qAlong] = [plane.along.dot(skin.right), plane.along.dot(skin.front)];
  const [pOut, qOut] = [plane.out.dot(skin.right), plane.out.dot(skin.front)];
  const layers = tissue.layers.map(({ texture, normal, from: start, thickness }) => ({
    texture, thickness, start: start + normal.dot(from),
    along: normal.dot(plane.along), out: normal.dot(plane.out), deep: normal.dot(plane.inward),
  })); // biome-ignore format: short
  const { vein } = tissue;
  const [tipAlong, tipOut, tipDeep] = dents.tip;
  const [axisAlong, axisOut, axisDeep] = dents.axis;
  const dented = dents.most > 0;
  const sharp = 1 / dents.width ** 2;
  const stepAcross = width / columns;
  const stepDown = depth / rows;
  const blurred = Math.max(FACE_MM, 0.7 * stepDown);
  for (let row = 0; row < rows; row++) {
    const d0 = (row + 0.5) * stepDown;
    const fade = (FADE * d0) / depth - (d0 < 0.5 ? 60 * (1 - 2 * d0) : 0);
    const shiftAlong = dents.rows[3 * row]!;
    const shiftOut = dents.rows[3 * row + 1]!;
    const shiftDeep = dents.rows[3 * row + 2]!;
    const moved = dented && Math.abs(shiftAlong) + Math.abs(shiftOut) + Math.abs(shiftDeep) > 0.005;
    for (let column = 0; column < columns; column++) {
      const a0 = (column + 0.5) * stepAcross - width / 2;
      let a = a0;
      let e = 0;
      let d = d0;
      if (moved) {
        const x = a0 - tipAlong;
        const y = -tipOut;
        const z = d0 - tipDeep;
        const on = x * axisAlong + y * axisOut + z * axisDeep;
        const near = 1 + Math.max(0, x * x + y * y + z * z - on * on) * sharp;
        const part = 1 / (near * Math.sqrt(near));
        a -= part * shiftAlong;
        e -= part * shiftOut;
        d -= part * shiftDeep;
      }
      const p = p0 + a * pAlong + e * pOut;
      const q = q0 + a * qAlong + e * qOut;
      let texture: Texture = d > tissue.deep ? tissue.behind : tissue.between;
      let edge = 0;
      for (let i = 0; i < layers.length; i++) {
        const layer = layers[i]!;
        const s = layer.start + a * layer.along + e * layer.out + d * layer.deep;
        if (s >= 0 && s <= layer.thickness) texture = layer.texture;
        const face = Math.min(Math.abs(s), Math.abs(s - layer.thickness));
        if (face < blurred) edge = Math.max(edge, FACE * (1 - face / blurred) * Math.abs(layer.deep));
      }
      if (vein) {
        const below = d - vein.depth;
        const away = Math.sqrt(q * q + below * below) - vein.radius;
        if (away < 0) {
          texture = TEXTURES.blood;
          edge = 0;
        } else if (away < Math.max(vein.wall, blurred)) texture = TEXTURES.wall;
        else if (below > 0 && Math.abs(q) < vein.radius) edge = ENHANCED;
      }
      // Two parts of the block at different scales, so that its period does not show.
      const u = p * ACROSS_PER_MM;
      const v = q * ACROSS_PER_MM;
      const w = d * DEEP_PER_MM;
      const grain =
        0.65 * grains[voxel(u, v, w)]! + 0.35 * grains[voxel(0.62 * u + 19, 0.62 * v + 7, 0.71 * w + 40)]! - 128;
      let grey = texture.level + texture.grain * grain + edge - fade;
      if (texture.line > 0) {
        const phase = d * texture.perMm + texture.wave * Math.sin(0.55 * p + 0.21 * q) + 0.4 * Math.sin(0.37 * q);
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
