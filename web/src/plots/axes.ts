import type { Pen } from "./pen.ts";
import { Scale } from "./scale.ts";
import type { Theme } from "./theme.ts";
import { label, niceStep, ticks } from "./ticks.ts";

/** A rectangle with an axis below and one to the left. Pixels. */
export class Pane {
  readonly x = new Scale();
  readonly y = new Scale();
  left = 0;
  top = 0;
  width = 1;
  height = 1;

  place(left: number, top: number, width: number, height: number): void {
    this.left = left;
    this.top = top;
    this.width = Math.max(1, width);
    this.height = Math.max(1, height);
  }
  rangeX(min: number, max: number): void {
    this.x.set(min, max, this.left, this.left + this.width);
  }
  rangeY(min: number, max: number): void {
    this.y.set(min, max, this.top + this.height, this.top);
  }
  holds(x: number, y: number): boolean {
    return x >= this.left && x <= this.left + this.width && y >= this.top && y <= this.top + this.height;
  }
}

/** Space for the axis numbers, px. */
export const MARGIN = { left: 44, right: 12, top: 20, bottom: 22 } as const;

const NAME = 84; // px kept free at the right end of the x axis for its name

/** Draws a pane's grid and numbers. The names of the axes stand at its corners. */
export function drawAxes(pen: Pen, pane: Pane, theme: Theme, names: { readonly x?: string; readonly y: string }): void {
  const { left, top, width, height, x, y } = pane;
  const right = left + width;
  const bottom = top + height;
  const grid = { colour: theme.line, width: 1, alpha: 0.6 };
  const stepY = niceStep(y.max - y.min, height / 38);
  for (const value of ticks(y.min, y.max, stepY)) {
    const at = Math.round(y.px(value)) + 0.5;
    pen.segment(left, at, right, at, grid);
    pen.text(left - 6, at, label(value, stepY), { colour: theme.quiet, anchor: "end" });
  }
  const stepX = niceStep(x.max - x.min, width / 70);
  for (const value of ticks(x.min, x.max, stepX)) {
    const at = Math.round(x.px(value)) + 0.5;
    pen.segment(at, top, at, bottom, grid);
    if (names.x && at < right - NAME)
      pen.text(at, bottom + 11, label(value, stepX), { colour: theme.quiet, anchor: "middle" });
  }
  if (y.min < 0 && y.max > 0) {
    const zero = Math.round(y.px(0)) + 0.5;
    pen.segment(left, zero, right, zero, { colour: theme.quiet, width: 1, alpha: 0.8 });
  }
  pen.text(left, top - 9, names.y, { colour: theme.text });
  if (names.x) pen.text(right, bottom + 11, names.x, { colour: theme.text, anchor: "end" });
}
