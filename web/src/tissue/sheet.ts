import { Brush, type Rgb, smooth } from "./brush.ts";
import { arteryWall, blood, cerebrospinalFluid, dura, fascia, flavum, ligament, muscle, veinWall } from "./firm.ts";
import type { Fill, Layer, Vessel } from "./layers.ts";
import { epiduralSpace, fat, type Painter, plain, plainTissue, skin } from "./soft.ts";

const PAINTERS: Readonly<Record<Fill, Painter>> = {
  plain,
  skin,
  fat,
  muscle,
  fascia,
  ligament,
  "ligamentum flavum": flavum,
  dura,
  "vein wall": veinWall,
  "artery wall": arteryWall,
  tissue: plainTissue,
  blood: blood(false),
  "epidural space": epiduralSpace,
  "cerebrospinal fluid": cerebrospinalFluid,
};
const arterial = blood(true);

/** A picture in memory, RGBA, 8 bits each. `width` x `height` pixels for `across` x `down` mm. */
export interface Sheet {
  readonly pixels: Uint8Array;
  readonly width: number;
  readonly height: number;
  /** Whether the picture can be repeated downwards too. */
  readonly tiles: boolean;
  /** Paints rows `from` to `to`, each block of `step` x `step` pixels in one colour. */
  paint(from: number, to: number, step: number): void;
}

/** Pixels of a sheet per cell of its finest pattern. */
const PIXELS_PER_CELL = 5;

type Point = (brush: Brush, x: number, y: number) => boolean;

/** point: sets the brush's colour at (x, y) mm and returns whether the point is opaque. */
function sheet(across: number, down: number, perMm: number, repeat: number, tiles: boolean, point: Point): Sheet {
  const width = Math.max(8, Math.round(across * perMm));
  const height = Math.max(8, Math.round(down * perMm));
  const pixels = new Uint8Array(4 * width * height);
  const brush = new Brush(repeat, perMm / PIXELS_PER_CELL);
  return {
    pixels,
    width,
    height,
    tiles,
    paint(from, to, step) {
      for (let row = from; row < Math.min(to, height); row += step) {
        const y = ((row + step / 2) / height) * down;
        for (let column = 0; column < width; column += step) {
          const opaque = point(brush, ((column + step / 2) / width) * across, y);
          for (let j = row; j < Math.min(row + step, height); j++) {
            for (let i = column; i < Math.min(column + step, width); i++) {
              const at = 4 * (j * width + i);
              pixels[at] = Math.min(255, brush.r);
              pixels[at + 1] = Math.min(255, brush.g);
              pixels[at + 2] = Math.min(255, brush.b);
              pixels[at + 3] = opaque ? 255 : 0;
            }
          }
        }
      }
    },
  };
}

/** Darkens a layer's borders a little, as in a drawing. */
function border(brush: Brush, y: number, height: number): void {
  const edge = Math.min(0.3, 0.25 * height);
  brush.light(1 - 0.16 * smooth(edge, 0, Math.min(y, height - y)));
}

const SAMPLES = 12; // along, and down

/** The mean colour of a layer in the cut, 0 to 255. artery: whether its blood is arterial. */
export function toneOf({ fill, top, bottom }: Layer, artery: boolean): Rgb {
  const height = bottom - top;
  const brush = new Brush(SAMPLES);
  const sum: [number, number, number] = [0, 0, 0];
  for (let i = 0; i < SAMPLES ** 2; i++) {
    const y = (((i % SAMPLES) + 0.5) / SAMPLES) * height;
    (fill === "blood" && artery ? arterial : PAINTERS[fill])(brush, Math.floor(i / SAMPLES) + 0.5, y, height);
    [brush.r, brush.g, brush.b].forEach((value, k) => {
      sum[k]! += value / SAMPLES ** 2;
    });
  }
  return sum;
}

/** The cut along the vessel: every layer from the surface down, `width` mm wide. It repeats along its width. */
export function cutSheet(layers: readonly Layer[], vessel: Vessel | null, width: number, perMm: number): Sheet {
  return sheet(width, layers.at(-1)!.bottom, perMm, width, false, (brush, x, y) => {
    const layer = layers.find(({ bottom }) => y < bottom) ?? layers.at(-1)!;
    const height = layer.bottom - layer.top;
    const below = y - layer.top;
    if (layer.fill === "blood") (vessel?.artery ? arterial : PAINTERS.blood)(brush, x, below, height);
    else if (vessel && layer.membrane === vessel.walls[1]) PAINTERS[layer.fill](brush, x, height - below, height);
    else PAINTERS[layer.fill](brush, x, below, height);
    if (layer.fill !== "blood") border(brush, below, height);
    return true;
  });
}

/** The block's end: the layers, and the vessel as half a circle at the left border, with an open lumen. */
export function endSheet(layers: readonly Layer[], vessel: Vessel | null, width: number, perMm: number): Sheet {
  const bed = layers.find((layer, i) => layers[i + 1]?.membrane === vessel?.walls[0] && layer.membrane === null);
  const middle = vessel ? (vessel.outer[0] + vessel.outer[1]) / 2 : 0;
  const outer = vessel ? (vessel.outer[1] - vessel.outer[0]) / 2 : 0;
  const inner = vessel ? (vessel.inner[1] - vessel.inner[0]) / 2 : 0;
  return sheet(width, layers.at(-1)!.bottom, perMm, width, false, (brush, x, y) => {
    const r = Math.hypot(x, y - middle);
    if (vessel && r < outer) {
      PAINTERS[vessel.artery ? "artery wall" : "vein wall"](
        brush,
        3 * Math.atan2(y - middle, x),
        outer - r,
        outer - inner,
      );
      return r > inner;
    }
    const layer = layers.find(({ bottom }) => y < bottom) ?? layers.at(-1)!;
    const beside = vessel && y > vessel.outer[0] && y < vessel.outer[1];
    const fill = beside ? (bed?.fill ?? "tissue") : layer.fill;
    const top = beside ? vessel.outer[0] : layer.top;
    const height = beside ? outer * 2 : layer.bottom - layer.top;
    PAINTERS[fill](brush, x, y - top, height);
    if (!beside) border(brush, y - top, height);
    if (vessel) brush.light(1 - 0.3 * smooth(1.35 * outer, outer, r));
    return true;
  });
}

/** The surface from above, `width` x `width` mm. */
export function surfaceSheet(layers: readonly Layer[], width: number, perMm: number): Sheet {
  const top = layers[0]!;
  return sheet(width, width, perMm, width, true, (brush, x, z) => {
    if (top.fill === "skin") skinFromAbove(brush, x, z);
    else PAINTERS[top.fill](brush, x, z, Math.max(4, top.bottom - top.top));
    return true;
  });
}

/** Skin from above: a net of fine creases with pores at its crossings, and a little warmth from below. */
function skinFromAbove(brush: Brush, x: number, z: number): void {
  brush.set([232, 186, 156]);
  brush.mix([222, 160, 134], 0.6 * smooth(0.35, 0.8, brush.cloud(x, z, 0.18, 0.2, 200)));
  brush.mix([244, 206, 180], 0.5 * smooth(0.45, 0.85, brush.cloud(x, z, 0.35, 0.3, 204)));
  const plate = brush.cells(x + 0.3 * brush.noise(x, z, 0.5, 0.5, 208), z, 1.5, 1.1, 209);
  brush.mix([186, 128, 104], 0.3 * smooth(0.16, 0.02, plate.second - plate.first));
  brush.mix([160, 100, 82], 0.5 * smooth(0.11, 0.03, plate.first) * smooth(0.8, 0.9, plate.value));
  brush.light(0.96 + 0.07 * brush.noise(x, z, 5, 5, 212));
}
