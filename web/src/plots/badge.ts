import type { Pen } from "./kit/pen.ts";
import { colourOf, type Theme } from "./kit/theme.ts";

/** A membrane's number in its colour. The number serves readers who cannot tell the colours apart. */
export function drawBadge(pen: Pen, x: number, y: number, membrane: number, theme: Theme): void {
  pen.dot(x, y, 7, colourOf(theme, membrane), theme.panel);
  pen.text(x, y + 0.5, String(membrane + 1), { colour: theme.panel, size: 10, anchor: "middle", bold: true });
}
