import { textWidth } from "./labels.ts";
import type { Pen } from "./pen.ts";
import { label, niceStep, Scale, ticks } from "./scale.ts";
import type { Theme } from "./theme.ts";

/** A rectangle with an axis below and one to the left. Pixels. */
export class Pane {
  readonly x = new Scale();
  readonly y = new Scale();
  left = 0;
  top = 0;
  width = 1;
  height = 1;

  get right(): number {
    return this.left + this.width;
  }
  get bottom(): number {
    return this.top + this.height;
  }
  place(left: number, top: number, width: number, height: number): void {
    this.left = left;
    this.top = top;
    this.width = Math.max(1, width);
    this.height = Math.max(1, height);
  }
  rangeX(min: number, max: number, log = false): void {
    this.x.set(min, max, this.left, this.right, log);
  }
  rangeY(min: number, max: number, log = false): void {
    this.y.set(min, max, this.bottom, this.top, log);
  }
  holds(x: number, y: number): boolean {
    return x >= this.left && x <= this.right && y >= this.top && y <= this.bottom;
  }
}

/** Space for the numbers and names of the axes, px. The names have rows of their own. */
export const MARGIN = { left: 44, right: 12, top: 20, bottom: 36 } as const;

const NUMBERS = 11; // px from the lower edge of a pane to the middle of the numbers of its x axis
const NAME = 26; // px from there to the middle of the axis' name
const APART = 12; // px, at least, between two numbers of the x axis

/** A step for the x axis at which its numbers do not touch each other. */
function stepOf({ x, width }: Pane): number {
  const span = x.max - x.min;
  for (let wanted = width / 55; ; wanted /= 1.5) {
    const step = niceStep(span, wanted);
    const widest = Math.max(...ticks(x.min, x.max, step).map((value) => textWidth(label(value, step))), 0);
    const moved = Math.max(widest / 2 - MARGIN.right, 0); // the last number stays inside the picture
    if (widest + moved + APART <= (step / span) * width || wanted <= 1) return step;
  }
}

/**
 * Draws a pane's grid and numbers, and the names of its axes. Without `x`, the pane below has the x axis. least: the
 * smallest step of the x axis, 1 for whole numbers.
 */
export function drawAxes(
  pen: Pen,
  pane: Pane,
  theme: Theme,
  names: { readonly x?: string; readonly y: string },
  least = 0,
): void {
  const { left, right, top, bottom, width, height, x, y } = pane;
  const grid = { colour: theme.line, width: 1, alpha: 0.6 };
  const quiet = { colour: theme.quiet } as const;
  const [low, high] = [Math.min(y.min, y.max), Math.max(y.min, y.max)]; // an axis may point down
  const stepY = niceStep(high - low, height / 30);
  for (const value of ticks(low, high, stepY)) {
    const at = Math.round(y.px(value)) + 0.5;
    pen.segment(left, at, right, at, grid);
    pen.text(left - 6, at, label(value, stepY), { ...quiet, anchor: "end" });
  }
  const stepX = Math.max(stepOf(pane), least);
  for (const value of ticks(x.min, x.max, stepX)) {
    const at = Math.round(x.px(value)) + 0.5;
    pen.segment(at, top, at, bottom, grid);
    const text = label(value, stepX);
    const inside = Math.min(at, right + MARGIN.right - textWidth(text) / 2);
    if (names.x) pen.text(inside, bottom + NUMBERS, text, { ...quiet, anchor: "middle" });
  }
  if (y.min * y.max < 0) {
    const zero = Math.round(y.px(0)) + 0.5;
    pen.segment(left, zero, right, zero, { colour: theme.quiet, width: 1, alpha: 0.8 });
  }
  pen.text(left, top - 9, names.y, { colour: theme.text });
  if (names.x) pen.text(left + width / 2, bottom + NAME, names.x, { colour: theme.text, anchor: "middle" });
}
