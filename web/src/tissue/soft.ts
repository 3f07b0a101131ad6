import { type Brush, type Rgb, smooth } from "./brush.ts";

/** Paints one point: x along the cut, y below the layer's upper face, height: of the layer, mm. */
export type Painter = (brush: Brush, x: number, y: number, height: number) => void;

const HORN: Rgb = [196, 140, 104];
const EPIDERMIS: Rgb = [226, 171, 138];
const BASAL: Rgb = [168, 98, 78];
const DERMIS: Rgb = [240, 196, 178];
const COLLAGEN: Rgb = [250, 222, 206];
const CAPILLARY: Rgb = [190, 62, 60];

/** Skin: a horny border, the epidermis with its wavy lower edge, and the dermis with collagen and capillaries. */
export const skin: Painter = (brush, x, y, height) => {
  const papilla = 0.5 + 0.5 * Math.sin(40 * brush.noise(x, 0, 1.6, 1, 3) + 2 * brush.noise(x, 0, 6, 1, 4));
  const epidermis = Math.min(0.3 * height, 0.16 + 0.12 * papilla + 0.05 * height);
  if (y < 0.045) return brush.set(HORN);
  if (y < epidermis) {
    brush.set(EPIDERMIS);
    brush.mix(BASAL, smooth(0.55, 1, y / epidermis) * 0.75);
    return brush.light(0.94 + 0.12 * brush.noise(x, y, 14, 18));
  }
  brush.set(DERMIS);
  const wave = 0.3 * brush.noise(x, y, 1.2, 1.5, 5);
  brush.mix(COLLAGEN, smooth(0.45, 0.8, brush.noise(x, y + wave, 1.6, 16, 6)) * 0.75);
  brush.mix([214, 146, 130], smooth(0.55, 0.85, brush.cloud(x, y, 1.1, 2.2, 7)) * 0.5);
  const vessel = Math.abs(brush.noise(x, y, 1.1, 1.6, 8) - 0.5);
  const upper = smooth(0.75, 0.25, y / height);
  brush.mix(CAPILLARY, smooth(0.024, 0.008, vessel) * (0.25 + 0.5 * upper));
  brush.light(0.95 + 0.08 * brush.noise(x, y, 9, 9, 9));
};

const LOBULE: Rgb = [248, 211, 106];
const BRIGHT: Rgb = [254, 236, 170];
const SEPTUM: Rgb = [214, 148, 78];
const STRAND: Rgb = [244, 224, 196];

/** Fat: lobules of large, bright cells in a net of septa. */
export const fat: Painter = (brush, x, y, height) => {
  const size = height > 8 ? 0.42 : 0.6; // lobules per mm
  const warp = 0.5 * brush.noise(x, y, 0.5, 0.5, 20);
  const lobule = brush.cells(x + warp, y + warp, size, size * 1.35, 21);
  const border = lobule.second - lobule.first;
  const tone = lobule.value;
  brush.set(LOBULE);
  brush.mix([240, 188, 84], tone * 0.55);
  const cell = brush.cells(x, y, size * 4, size * 4.4, 25);
  brush.mix(BRIGHT, 0.7 * smooth(0.6, 0.05, cell.first));
  brush.mix(SEPTUM, 0.22 * smooth(0.16, 0.03, cell.second - cell.first));
  brush.mix(SEPTUM, 0.6 * smooth(0.22, 0.08, border));
  brush.mix(STRAND, 0.9 * smooth(0.09, 0.03, border));
  const vessel = Math.abs(brush.noise(x, y, 0.16, 0.2, 29) - 0.5);
  brush.mix(CAPILLARY, 0.65 * smooth(0.011, 0.004, vessel));
  brush.light(0.97 + 0.06 * brush.noise(x, y, 0.3, 0.3, 30));
};

/** The loose fat of the epidural space: pale globules with gaps, and thin-walled veins. */
export const epiduralSpace: Painter = (brush, x, y, height) => {
  const globule = brush.cells(x, y, 0.85, 0.95, 40);
  brush.set([196, 138, 96]);
  const body = smooth(0.62, 0.36, globule.first);
  brush.mix([250, 226, 150], body);
  brush.mix([255, 245, 205], body * smooth(0.3, 0.02, globule.first) * 0.8);
  const strand = Math.abs(brush.noise(x, y, 0.5, 0.9, 44) - 0.5);
  brush.mix(STRAND, 0.5 * smooth(0.05, 0.015, strand));
  const plexus = brush.cells(x, y, 0.13, 1 / Math.max(2, height), 46);
  const vein = plexus.first;
  brush.mix([70, 62, 120], smooth(0.13, 0.115, vein));
  brush.mix([122, 40, 62], smooth(0.1, 0.09, vein));
};

/** Connective tissue without a name: soft and pale. */
export const plainTissue: Painter = (brush, x, y) => {
  brush.set([233, 200, 184]);
  const wave = 0.5 * brush.noise(x, y, 0.4, 0.5, 60);
  brush.mix([214, 168, 150], smooth(0.4, 0.8, brush.noise(x, y + wave, 0.7, 5, 61)) * 0.6);
  brush.mix([247, 226, 214], smooth(0.5, 0.9, brush.cloud(x, y, 0.6, 0.8, 62)) * 0.7);
};

/** A membrane with the look "plain" between others: an even grey. */
export const plain: Painter = (brush, x, y) => {
  brush.set([186, 192, 200]);
  brush.light(0.97 + 0.06 * brush.noise(x, y, 2, 2, 65));
};
