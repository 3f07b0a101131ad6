/** Values that a picture was drawn with, each in the smallest step that can be seen. */
export class Shown {
  private values: readonly number[] = [];

  /**
   * Whether one of the values is a step or more away from what was drawn. If so, the new values count as drawn. A value
   * that trembles by less than a step asks for no new picture.
   */
  differs(values: readonly number[]): boolean {
    const before = this.values;
    if (values.length === before.length && values.every((value, i) => Math.abs(value - before[i]!) < 1)) return false;
    this.values = values;
    return true;
  }

  forget(): void {
    this.values = [];
  }
}
