import type { Source } from "../state/source.ts";
import type { Pen } from "./pen.ts";
import type { Theme } from "./theme.ts";

const CHARACTER = 5.7; // px, about, of a plot's letters
const LINE = 16;

/** A line of a plot and what it is. */
export interface KeyEntry {
  readonly text: string;
  readonly colour: string;
}

/** The solver that runs beside the present one. */
export const otherName = (source: Source): string =>
  `${source.scene.value?.solver === "paper" ? "exact" : "paper"} solver`;

/** Entries in a row that ends at `right`, with their middle at y. */
export function drawKey(pen: Pen, right: number, y: number, entries: readonly KeyEntry[], theme: Theme): void {
  let x = right;
  for (const { text, colour } of entries) {
    pen.text(x, y, text, { colour: theme.text, size: 10.5, anchor: "end", halo: theme.panel });
    x -= text.length * CHARACTER + 5;
    pen.segment(x - LINE, y, x, y, { colour, width: 2 });
    x -= LINE + 12;
  }
}
