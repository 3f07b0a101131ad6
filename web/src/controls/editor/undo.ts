/** An undo history. Quick steps of one `topic`, as in a drag, are merged into one. */
export class Undo<T> {
  private past: T[] = [];
  private future: T[] = [];
  private topic = "";
  private at = Number.NEGATIVE_INFINITY;

  /** together: steps of one topic within this time are merged, ms; most: longest history. */
  constructor(
    private present: T,
    private readonly together = 800,
    private readonly most = 200,
  ) {}

  get value(): T {
    return this.present;
  }
  get canUndo(): boolean {
    return this.past.length > 0;
  }
  get canRedo(): boolean {
    return this.future.length > 0;
  }

  /** Returns whether a new step began. */
  step(next: T, topic: string, now: number): boolean {
    const begins = topic === "" || topic !== this.topic || now - this.at > this.together;
    if (begins) this.past = [...this.past, this.present].slice(-this.most);
    this.present = next;
    this.future = [];
    this.topic = topic;
    this.at = now;
    return begins;
  }

  /** Replaces the present value without a step. */
  replace(present: T): void {
    this.present = present;
    this.topic = "";
  }

  /** Clears the history. */
  forget(present: T): void {
    this.replace(present);
    this.past = [];
    this.future = [];
  }

  undo(): T {
    const before = this.past.pop();
    if (before !== undefined) {
      this.future.push(this.present);
      this.replace(before);
    }
    return this.present;
  }

  redo(): T {
    const after = this.future.pop();
    if (after !== undefined) {
      this.past.push(this.present);
      this.replace(after);
    }
    return this.present;
  }
}
