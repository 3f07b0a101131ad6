import type { Polyline } from "./polyline.ts";

const SHORT = 2; // px: longer pieces are always drawn

/** Remembers which pixels of a box are painted, so that ten strokes along one line are drawn only once. */
export class Painted {
  private cells = new Uint8Array(0);
  private left = 0;
  private top = 0;
  private width = 0;
  private height = 0;
  private lastCell = -1;
  private lastInk = false;

  /** Marks all pixels of this box as not painted. */
  begin(left: number, top: number, width: number, height: number): void {
    this.left = Math.floor(left);
    this.top = Math.floor(top);
    this.width = Math.ceil(width) + 1;
    this.height = Math.ceil(height) + 1;
    this.lastCell = -1;
    const size = this.width * this.height;
    if (this.cells.length < size) this.cells = new Uint8Array(size);
    else this.cells.fill(0, 0, size);
  }

  /** Adds to `out` the pieces of `path` on pixels that are not painted yet, and marks those pixels. */
  addNew(path: Polyline, out: Polyline): void {
    const { xs, ys, count } = path;
    let inkBefore = false;
    let drawing = false; // whether `out` ends at the point before
    for (let i = 0; i < count; i++) {
      const x = xs[i]!;
      const y = ys[i]!;
      if (Number.isNaN(y)) {
        out.gap();
        drawing = false;
        continue;
      }
      const first = i === 0 || Number.isNaN(ys[i - 1]!);
      const ink = this.ink(x, y);
      const short = !first && Math.abs(x - xs[i - 1]!) <= SHORT && Math.abs(y - ys[i - 1]!) <= SHORT;
      if (first && ink) drawing = false;
      else if (!first && ink && inkBefore && short) {
        out.gap();
        drawing = false;
      } else {
        if (!first && !drawing) out.add(xs[i - 1]!, ys[i - 1]!);
        out.add(x, y);
        drawing = true;
      }
      inkBefore = ink;
    }
    out.gap();
  }

  /** Marks a pixel as painted; returns whether it was before. Pixels outside the box count as painted. */
  private ink(x: number, y: number): boolean {
    const column = Math.floor(x) - this.left;
    const row = Math.floor(y) - this.top;
    if (column < 0 || row < 0 || column >= this.width || row >= this.height) return true;
    const cell = row * this.width + column;
    // Consecutive points in one pixel count as one: the first must not hide the others.
    if (cell === this.lastCell) return this.lastInk;
    this.lastCell = cell;
    this.lastInk = this.cells[cell] === 1;
    this.cells[cell] = 1;
    return this.lastInk;
  }
}
