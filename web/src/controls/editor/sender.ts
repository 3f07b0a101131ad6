/**
 * Sends values one request at a time. While a request is pending, a newer value replaces the one that waits. So a
 * slider drag never floods the server.
 */
export class LastWins<T, R> {
  private waiting: { readonly value: T } | null = null;
  private running = false;

  constructor(
    private readonly send: (value: T) => Promise<R>,
    /** last: no newer value waits. */
    private readonly done: (reply: R, value: T, last: boolean) => void,
  ) {}

  get busy(): boolean {
    return this.running || this.waiting !== null;
  }

  give(value: T): void {
    this.waiting = { value };
    if (!this.running) void this.run();
  }

  /** Drops the value that waits. */
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
