import type { Source } from "../state/source.ts";
import type { Pen } from "./pen.ts";
import type { Theme } from "./theme.ts";

const SIZE = 11.5; // px
const CHARACTER = 6; // px, approximate width of a letter of this size
const LINE = 16;
const EDGE = 3; // px

/** An entry of a plot's legend: a line or a shade, and its name. */
export interface KeyEntry {
  readonly text: string;
  readonly colour: string;
  /** Opacity of the shade; without it the entry is a line. */
  readonly shade?: number;
}

/** Name of the solver that runs next to the scene's solver while Compare is on. */
export const otherName = (source: Source): string =>
  `${source.scene.value?.solver === "paper" ? "exact" : "paper"} solver`;

/** Draws a shade with a dense upper edge, which stays visible if the shade is narrow or lines cover it. */
export function drawShade(
  pen: Pen,
  x: number,
  y: number,
  width: number,
  height: number,
  colour: string,
  alpha: number,
): void {
  pen.box(x, y, width, height, colour, alpha);
  pen.box(x, y, width, EDGE, colour, 0.9);
}

/** Draws the entries in a row that ends at `right` and is centred at y. */
export function drawKey(pen: Pen, right: number, y: number, entries: readonly KeyEntry[], theme: Theme): void {
  let x = right;
  for (const { text, colour, shade } of entries) {
    pen.text(x, y, text, { colour: theme.text, size: SIZE, anchor: "end", halo: theme.panel });
    x -= text.length * CHARACTER + 5;
    if (shade === undefined) pen.segment(x - LINE, y, x, y, { colour, width: 2.5 });
    else drawShade(pen, x - LINE, y - 5, LINE, 10, colour, shade);
    x -= LINE + 12;
  }
}
