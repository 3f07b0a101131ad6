/**
 * Sends the last of what it is given, one request at a time: while one is on its way, those that come meanwhile
 * replace one another. So a drag of a slider follows the server's own pace and never floods it.
 */
export class LastWins<T, R> {
  private waiting: { readonly value: T } | null = null;
  private running = false;

  constructor(
    private readonly send: (value: T) => Promise<R>,
    /** last: nothing newer waits. */
    private readonly done: (reply: R, value: T, last: boolean) => void,
  ) {}

  get busy(): boolean {
    return this.running || this.waiting !== null;
  }

  give(value: T): void {
    this.waiting = { value };
    if (!this.running) void this.run();
  }

  /** Forgets what has not been sent yet. */
  drop(): void {
    this.waiting = null;
  }

  private async run(): Promise<void> {
    this.running = true;
    try {
      while (this.waiting) {
        const { value } = this.waiting;
        this.waiting = null;
        const reply = await this.send(value);
        this.done(reply, value, this.waiting === null);
      }
    } finally {
      this.running = false;
    }
  }
}
