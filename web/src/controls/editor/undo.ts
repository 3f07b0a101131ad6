/** What was, what is and what was undone. Steps of one `topic` that follow closely, as a drag makes them, are one. */
export class Undo<T> {
  private past: T[] = [];
  private future: T[] = [];
  private topic = "";
  private at = Number.NEGATIVE_INFINITY;

  /** together: ms within which steps of one topic are one. */
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

  /** Another present that is no step of the person's. */
  replace(present: T): void {
    this.present = present;
    this.topic = "";
  }

  /** Begins anew. */
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
