import { type Cell, cells, cloud, noise } from "./noise.ts";

export type Rgb = readonly [number, number, number];

/** Random patterns in millimetres that repeat after `width` mm along x. */
export class Brush {
  /** The colour of the present point, 0 to 255. */
  r = 0;
  g = 0;
  b = 0;
  private readonly cell: Cell = { first: 0, second: 0, value: 0 };

  /** finest: cells per mm of the finest pattern. Finer ones would only flicker on the screen. */
  constructor(
    readonly width: number,
    private readonly finest = Number.POSITIVE_INFINITY,
  ) {}

  /** Cells along the width, so that the pattern repeats. perMm: wanted cells per mm. */
  private count(perMm: number): number {
    return Math.max(1, Math.round(Math.min(perMm, this.finest) * this.width));
  }

  /** Noise from 0 to 1; along, across: cells per mm in both directions. Fibres are noise with few cells along. */
  noise(x: number, y: number, along: number, across: number, kind = 0): number {
    const count = this.count(along);
    return noise((x * count) / this.width, y * Math.min(across, this.finest), count, kind);
  }

  cloud(x: number, y: number, along: number, across: number, kind = 0): number {
    const count = this.count(along);
    return cloud((x * count) / this.width, y * across, count, 3, kind);
  }

  /** Voronoi cells; perMm: cells per mm along x, and per mm along y. */
  cells(x: number, y: number, along: number, across: number, kind = 0): Cell {
    const count = this.count(along);
    return cells((x * count) / this.width, y * Math.min(across, this.finest), count, this.cell, kind);
  }

  set(colour: Rgb): void {
    [this.r, this.g, this.b] = colour;
  }

  /** Mixes a share of another colour in. */
  mix(colour: Rgb, share: number): void {
    const part = share < 0 ? 0 : share > 1 ? 1 : share;
    this.r += part * (colour[0] - this.r);
    this.g += part * (colour[1] - this.g);
    this.b += part * (colour[2] - this.b);
  }

  /** Multiplies the brightness. */
  light(factor: number): void {
    this.r *= factor;
    this.g *= factor;
    this.b *= factor;
  }
}

/** 0 below `low`, 1 above `high`, smooth between. */
export function smooth(low: number, high: number, x: number): number {
  const part = Math.min(1, Math.max(0, (x - low) / (high - low)));
  return part * part * (3 - 2 * part);
}
