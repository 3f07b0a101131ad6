/** A linear map from values to pixels. */
export class Scale {
  min = 0;
  max = 1;
  /** The pixels of `min` and `max`. */
  from = 0;
  to = 1;

  set(min: number, max: number, from: number, to: number): void {
    this.min = min;
    this.max = max;
    this.from = from;
    this.to = to;
  }
  px(value: number): number {
    return this.from + ((value - this.min) / (this.max - this.min)) * (this.to - this.from);
  }
  value(px: number): number {
    return this.min + ((px - this.from) / (this.to - this.from)) * (this.max - this.min);
  }
}
