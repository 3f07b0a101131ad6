import type { Source } from "../state/source.ts";
import type { Pane } from "./kit/axes.ts";
import { apart, textWidth } from "./kit/labels.ts";
import type { Pen } from "./kit/pen.ts";
import { colourOf, type Theme } from "./kit/theme.ts";

const SIZE = 11.5; // px
const ROW = 14; // px
const ASIDE = 8; // px from a curve's end to its name
const ABOVE = 9; // px from it up to the name's middle: a curve through the name would strike it out

/** The end of a curve, px, and its name. */
export interface End {
  readonly x: number;
  readonly y: number;
  readonly text: string;
  readonly colour: string;
}

export const nameOf = ({ scene }: Source, membrane: number): string =>
  scene.value?.membranes[membrane]?.name || `membrane ${membrane + 1}`;

export const endAt = (source: Source, membrane: number, x: number, y: number, theme: Theme): End => ({
  x,
  y,
  text: nameOf(source, membrane),
  colour: colourOf(theme, membrane),
});

/** Draws the ends of curves that are inside a pane, with their names beside them, none over another. */
export function drawEnds(pen: Pen, pane: Pane, all: readonly End[], theme: Theme): void {
  const ends = all.filter(({ x, y }) => pane.holds(x, y));
  const left = ends.map(({ x, text }) => {
    const wide = textWidth(text, SIZE);
    return x + ASIDE + wide <= pane.right ? x + ASIDE : x - ASIDE - wide;
  });
  const right = ends.map(({ text }, i) => left[i]! + textWidth(text, SIZE));
  const meet = (i: number, j: number): boolean => left[i]! < right[j]! && left[j]! < right[i]!;
  const wanted = ends.map(({ y }) => y - ABOVE);
  const middles = apart(wanted, ROW, [pane.top + ROW / 2, pane.bottom - ROW / 2], meet);
  ends.forEach(({ x, y, colour }, i) => {
    if (Math.abs(middles[i]! - wanted[i]!) < ROW / 2) return;
    const side = left[i]! > x ? left[i]! : right[i]!;
    pen.segment(x, y, side, middles[i]!, { colour, width: 1 });
  });
  for (const { x, y, colour } of ends.toReversed()) pen.dot(x, y, 4, colour, theme.panel);
  ends.forEach(({ text, colour }, i) => {
    pen.text(left[i]!, middles[i]!, text, { colour, size: SIZE, bold: true, halo: theme.panel });
  });
}
