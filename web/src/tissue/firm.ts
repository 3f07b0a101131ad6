import { type Rgb, smooth } from "./brush.ts";
import type { Painter } from "./soft.ts";

const FIBRE: Rgb = [168, 58, 52];
const DEEP: Rgb = [122, 34, 34];
const PERIMYSIUM: Rgb = [226, 168, 152];

/** Muscle: long bundles along the cut, with fine stripes, between pale sheaths. Its upper border is a fascia. */
export const muscle: Painter = (brush, x, y, height) => {
  const bend = 0.7 * brush.noise(x, y, 0.12, 0.2, 70) + 0.1 * brush.noise(x, y, 0.5, 1, 71);
  const bundle = brush.cells(x, y + bend, 0.07, 1.15, 72);
  brush.set(FIBRE);
  brush.mix([190, 84, 74], 0.6 * bundle.value);
  const fibre = brush.noise(x, y + bend, 0.35, 13, 75);
  brush.mix(DEEP, smooth(0.5, 0.9, fibre) * 0.75);
  brush.mix([212, 112, 98], smooth(0.55, 0.95, brush.noise(x, y + bend, 0.3, 17, 76)) * 0.45);
  brush.light(0.97 + 0.05 * Math.sin(2 * Math.PI * Math.round(9 * brush.width) * (x / brush.width)));
  brush.mix(PERIMYSIUM, 0.75 * smooth(0.15, 0.04, bundle.second - bundle.first));
  if (height > 1.5) brush.mix([238, 226, 220], 0.9 * smooth(0.34, 0.2, y + 0.12 * brush.noise(x, 0, 1.2, 1, 78)));
};

/** A sheet of parallel fibres. */
export const fascia: Painter = (brush, x, y) => {
  brush.set([226, 224, 222]);
  brush.mix([178, 182, 190], smooth(0.4, 0.9, brush.noise(x, y, 0.7, 22, 80)) * 0.8);
  brush.mix([252, 252, 250], smooth(0.6, 0.95, brush.noise(x, y, 0.5, 14, 81)) * 0.8);
};

/** Ligament: wavy bundles of pale collagen. In a thick one they run obliquely, with fat between them. */
export const ligament: Painter = (brush, x, y, height) => {
  const thick = smooth(6, 10, height);
  const slant = thick * 0.09 * brush.width * Math.sin((2 * Math.PI * x) / brush.width);
  const crimp = 0.07 * Math.sin(2 * Math.PI * Math.round(0.55 * brush.width) * (x / brush.width) + 5 * y);
  const wave = slant + crimp + 0.5 * brush.noise(x, y, 0.25, 0.3, 90);
  const bundle = brush.cells(x, y + wave, 0.06, thick > 0.5 ? 0.75 : 1.5, 91);
  brush.set([236, 224, 202]);
  brush.mix([216, 196, 166], 0.7 * bundle.value);
  brush.mix([250, 244, 230], smooth(0.45, 0.9, brush.noise(x, y + wave, 0.3, 9, 92)) * 0.8);
  brush.mix([186, 158, 128], smooth(0.62, 0.95, brush.noise(x, y + wave, 0.3, 12, 93)) * 0.7);
  const gap = smooth(0.12, 0.03, bundle.second - bundle.first);
  brush.mix([176, 136, 104], 0.6 * gap);
  brush.mix([246, 208, 120], thick * 0.8 * gap * smooth(0.45, 0.6, brush.noise(x, y, 0.4, 0.5, 94)));
};

/** Ligamentum flavum: dense, yellow, elastic. */
export const flavum: Painter = (brush, x, y, height) => {
  const wave = 0.25 * brush.noise(x, y, 0.2, 0.5, 100);
  brush.set([226, 178, 58]);
  brush.mix([246, 212, 104], smooth(0.35, 0.85, brush.noise(x, y + wave, 0.28, 7, 101)) * 0.9);
  brush.mix([176, 122, 30], smooth(0.5, 0.95, brush.noise(x, y + wave, 0.25, 11, 102)) * 0.8);
  brush.light(0.9 + 0.14 * smooth(0, 0.35, Math.min(y, height - y)));
};

/** Dura: a pearly, tight sheet between two dark borders. */
export const dura: Painter = (brush, x, y, height) => {
  brush.set([214, 224, 236]);
  brush.mix([164, 180, 202], smooth(0.4, 0.9, brush.noise(x, y, 0.6, 20, 110)) * 0.8);
  const edge = Math.min(y, height - y) / height;
  brush.mix([88, 104, 134], 0.75 * smooth(0.24, 0.06, edge));
};

/** Behind the dura: clear fluid, and the roots of the cauda equina as pale strands. */
export const cerebrospinalFluid: Painter = (brush, x, y, height) => {
  brush.set([168, 204, 222]);
  brush.mix([206, 230, 240], smooth(0.3, 0.8, brush.cloud(x, y, 0.12, 0.2, 120)) * 0.7);
  const sway = 0.8 * brush.noise(x, y, 0.07, 0.1, 121);
  const root = brush.cells(x, y + sway, 0.02, 0.62, 122);
  const strand = smooth(0.34, 0.24, root.first) * smooth(0.8, 1.6, y);
  brush.mix([240, 226, 186], 0.95 * strand);
  brush.mix([196, 170, 122], strand * smooth(0.5, 0.9, brush.noise(x, y + sway, 0.25, 9, 124)) * 0.7);
  brush.mix([150, 130, 100], 0.5 * smooth(0.4, 0.34, root.first) * smooth(0.26, 0.32, root.first));
  brush.light(1 - 0.12 * smooth(0.5, 1, y / height));
};

/** A vessel's wall from outside (depth 0) to the lumen (depth height): adventitia, muscle, and the inner lining. */
const wall =
  (outer: Rgb, media: Rgb, lining: Rgb): Painter =>
  (brush, x, y, height) => {
    const part = y / height;
    brush.set(outer);
    brush.mix(media, smooth(0.18, 0.36, part));
    brush.light(0.92 + 0.16 * brush.noise(x, y, 0.8, 26, 130));
    brush.mix(lining, smooth(0.74, 0.84, part));
  };
export const veinWall = wall([92, 112, 168], [186, 152, 186], [236, 196, 204]);
export const arteryWall = wall([206, 124, 108], [222, 108, 96], [250, 206, 186]);

/** Blood against the far side of an opened vessel; part: from the upper wall (0) to the lower one (1). */
export const blood =
  (artery: boolean): Painter =>
  (brush, x, y, height) => {
    const part = y / height;
    const across = 2 * part - 1;
    brush.set(artery ? [188, 34, 36] : [128, 24, 40]);
    brush.mix(artery ? [112, 12, 18] : [64, 8, 24], smooth(0.25, 0, part) * 0.85 + 0.3 * smooth(0.7, 1, part));
    brush.light(0.94 + 0.12 * brush.cloud(x, y, 0.25, 0.7, 140));
    const gleam = Math.exp(-(((across - 0.28 - 0.06 * brush.noise(x, 0, 0.3, 1, 143)) / 0.09) ** 2));
    brush.mix(artery ? [250, 150, 134] : [226, 120, 132], 0.55 * gleam * (0.5 + 0.5 * brush.noise(x, 0, 0.5, 1, 144)));
  };
