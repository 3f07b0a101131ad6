/** A growing list of points whose memory is reused after `clear`. NaN in `ys` is a gap. */
export class Polyline {
  xs: Float32Array;
  ys: Float32Array;
  count = 0;

  constructor(room = 4096) {
    this.xs = new Float32Array(room);
    this.ys = new Float32Array(room);
  }

  clear(): void {
    this.count = 0;
  }

  add(x: number, y: number): void {
    if (this.count === this.xs.length) this.grow();
    this.xs[this.count] = x;
    this.ys[this.count++] = y;
  }

  /** Ends the line here; the next point starts a new one. */
  gap(): void {
    if (this.count && !Number.isNaN(this.ys[this.count - 1]!)) this.add(Number.NaN, Number.NaN);
  }

  private grow(): void {
    const room = 2 * this.xs.length;
    const xs = new Float32Array(room);
    const ys = new Float32Array(room);
    xs.set(this.xs);
    ys.set(this.ys);
    this.xs = xs;
    this.ys = ys;
  }
}
