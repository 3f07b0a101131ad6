import type { ToPixels } from "./needle_echo.ts";
import type { Raster } from "./picture.ts";

const WIDEST_MM = 50; // of a linear probe
export const RULER_PX = 30;

/** Where the picture lies on the canvas: CSS pixels, and mm. */
export interface Frame extends ToPixels {
  readonly left: number;
  readonly top: number;
  readonly across: number;
  readonly down: number;
  readonly width: number;
  readonly depth: number;
}

/** The picture's frame on a canvas of this size, with a ruler to its right. depth: mm. */
export function frameOf(canvasWidth: number, canvasHeight: number, depth: number): Frame {
  const scale = Math.max(1, canvasHeight) / depth;
  const width = Math.min(WIDEST_MM, Math.max(1, canvasWidth - RULER_PX) / scale);
  const across = width * scale;
  const left = Math.max(0, (canvasWidth - RULER_PX - across) / 2);
  return {
    scale, left, top: 0, across, down: canvasHeight, width, depth,
    x: (along) => left + (along + width / 2) * scale,
    y: (below) => below * scale,
  }; // biome-ignore format: short
}

/** The tissue's raster in a frame, with about so many pixels and not more than the screen has. */
export function rasterOf({ across, down, width, depth }: Frame, pixels: number): Raster {
  const part = Math.min(1, Math.sqrt(pixels / (across * down)));
  return {
    columns: Math.max(8, Math.round(across * part)),
    rows: Math.max(8, Math.round(down * part)),
    width,
    depth,
  };
}

/** Places of the ruler's marks, mm: about eight, at round numbers. */
export function rulerMarks(depth: number): number[] {
  const step = depth > 40 ? 10 : depth > 16 ? 5 : 2;
  return Array.from({ length: Math.floor(depth / step) + 1 }, (_, i) => i * step).filter((at) => at < depth);
}
