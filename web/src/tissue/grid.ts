import type { Field } from "./field.ts";
import type { Layer } from "./layers.ts";

/** Half the columns of the cut's mesh. They are dense at the needle. */
const HALF = 22;
export const COLUMNS = 2 * HALF + 1;
const DENSITY = 2.2;
const ROWS_IN_BLOOD = 12;

/**
 * The drawn part of the tissue, mm: it is `size` wide on both sides of `centre`, however far the needle goes. On the
 * left and on the right it goes on for so much, at rest.
 */
export interface Window {
  readonly centre: number;
  readonly size: number;
  readonly left: number;
  readonly right: number;
}

/** Depths of the rows of the cut's mesh. Each border between layers is a row. */
export function rowsOf(layers: readonly Layer[]): number[] {
  const rows = [0];
  for (const { fill, top, bottom } of layers) {
    const height = bottom - top;
    const count = fill === "blood" ? ROWS_IN_BLOOD : Math.max(2, Math.min(9, Math.round(height * 1.2)));
    for (let i = 1; i <= count; i++) rows.push(top + (height * i) / count);
  }
  return rows;
}

const spot = { track: 0, u: 0, down: 0 };

/** One row of the deformed cut at depth d. Its ends and the lowest row stay where they are. */
export function bendRow(
  field: Field,
  d: number,
  bottom: number,
  window: Window,
  rest: Float32Array,
  moved: Float32Array,
  at: number,
): void {
  const { centre, size, left, right } = window;
  field.at(d, spot);
  const middle = Math.min(centre + 0.96 * size, Math.max(centre - 0.96 * size, spot.track));
  const held = d >= bottom ? 0 : 1;
  for (let i = -HALF; i <= HALF; i++) {
    const part = (Math.abs(i) / HALF) ** DENSITY;
    const more = i === -HALF ? -left : i === HALF ? right : 0;
    const u = middle * (1 - part) + (centre + Math.sign(i) * size) * part + more;
    const share = held * field.share(u - spot.track) * border(u, window);
    const out = at + i + HALF;
    rest[2 * out] = u;
    rest[2 * out + 1] = d;
    moved[3 * out] = u + share * spot.u;
    moved[3 * out + 1] = d + share * spot.down;
    moved[3 * out + 2] = 0;
  }
}

/** The triangles of a grid of `rows` rows of `columns` points. */
export function gridTriangles(rows: number, columns: number): number[] {
  const index: number[] = [];
  for (let row = 0; row + 1 < rows; row++) {
    for (let i = 0; i + 1 < columns; i++) {
      const a = row * columns + i;
      index.push(a, a + columns, a + 1, a + 1, a + columns, a + columns + 1);
    }
  }
  return index;
}

/** The part of a displacement that is left at u: 1 in the middle of the window, 0 at its border. */
export const border = (u: number, { centre, size }: Window): number =>
  1 - Math.min(1, Math.abs(u - centre) / size) ** 4;

/** How far a window must move so that `x` is not beyond `free` from its centre. */
export const follow = (x: number, free: number): number => Math.sign(x) * Math.max(0, Math.abs(x) - free);
