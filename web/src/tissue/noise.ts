/** Smooth random patterns for drawn tissue. They repeat along x, so that a texture can be scrolled without a seam. */

const SIZE = 4096; // a power of two
const RANDOM = random(20_011);

/** Numbers from 0 to 1, the same for each call with a seed (mulberry32). */
function random(seed: number): Float32Array {
  let state = seed;
  return Float32Array.from({ length: SIZE }, () => {
    state = (state + 0x6d2b79f5) | 0;
    let mixed = Math.imul(state ^ (state >>> 15), 1 | state);
    mixed = (mixed + Math.imul(mixed ^ (mixed >>> 7), 61 | mixed)) ^ mixed;
    return ((mixed ^ (mixed >>> 14)) >>> 0) / 4294967296;
  });
}

const wrapped = (x: number, period: number): number => ((x % period) + period) % period;

/** A random number from 0 to 1 that belongs to a cell of a grid. */
const cellValue = (x: number, y: number, kind = 0): number =>
  RANDOM[(Math.imul(x, 1619) + Math.imul(y, 31337) + Math.imul(kind, 6971)) & (SIZE - 1)]!;

/** Value noise from 0 to 1. It repeats along x after `period` cells, a whole number. */
export function noise(x: number, y: number, period: number, kind = 0): number {
  const left = Math.floor(x);
  const top = Math.floor(y);
  const fx = x - left;
  const fy = y - top;
  const sx = fx * fx * (3 - 2 * fx);
  const sy = fy * fy * (3 - 2 * fy);
  const x0 = wrapped(left, period);
  const x1 = x0 + 1 === period ? 0 : x0 + 1;
  const above = cellValue(x0, top, kind) * (1 - sx) + cellValue(x1, top, kind) * sx;
  const below = cellValue(x0, top + 1, kind) * (1 - sx) + cellValue(x1, top + 1, kind) * sx;
  return above * (1 - sy) + below * sy;
}

/** A few octaves of noise, from 0 to 1. */
export function cloud(x: number, y: number, period: number, octaves = 3, kind = 0): number {
  let sum = 0;
  let part = 0.5;
  let scale = 1;
  let whole = 0;
  for (let i = 0; i < octaves; i++) {
    sum += part * noise(x * scale, y * scale, period * scale, kind + i);
    whole += part;
    part /= 2;
    scale *= 2;
  }
  return sum / whole;
}

export interface Cell {
  /** Distance to the nearest seed, and to the second nearest, in cells. */
  first: number;
  second: number;
  /** A random number of the nearest seed, 0 to 1. */
  value: number;
}

/** Voronoi cells round seeds, one in each square of a grid: fat lobules, bundles of muscle. */
export function cells(x: number, y: number, period: number, out: Cell, kind = 0): Cell {
  const left = Math.floor(x);
  const top = Math.floor(y);
  out.first = out.second = 9;
  for (let j = -1; j <= 1; j++) {
    for (let i = -1; i <= 1; i++) {
      const cx = wrapped(left + i, period);
      const cy = top + j;
      const dx = left + i + 0.12 + 0.76 * cellValue(cx, cy, kind + 11) - x;
      const dy = cy + 0.12 + 0.76 * cellValue(cx, cy, kind + 12) - y;
      const distance = dx * dx + dy * dy;
      if (distance < out.first) {
        out.second = out.first;
        out.first = distance;
        out.value = cellValue(cx, cy, kind + 13);
      } else if (distance < out.second) out.second = distance;
    }
  }
  out.first = Math.sqrt(out.first);
  out.second = Math.sqrt(out.second);
  return out;
}
