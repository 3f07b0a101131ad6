import type { Reply } from "./engine.ts";

/** Requests that wait for their reply, by id. */
export class Pending {
  private readonly waiting = new Map<number, { resolve: (reply: Reply) => void; reject: (error: Error) => void }>();
  private last = 0;

  /** Returns a new id, and the promise of its reply. */
  add(): { id: number; reply: Promise<Reply> } {
    this.last += 1;
    const id = this.last;
    const reply = new Promise<Reply>((resolve, reject) => this.waiting.set(id, { resolve, reject }));
    return { id, reply };
  }

  /** False if no request has this id. */
  settle(reply: Reply): boolean {
    const asked = this.waiting.get(reply.id);
    this.waiting.delete(reply.id);
    asked?.resolve(reply);
    return asked !== undefined;
  }

  /** The connection was lost: no reply can come. */
  rejectAll(reason: string): void {
    const asked = [...this.waiting.values()];
    this.waiting.clear();
    for (const { reject } of asked) reject(new Error(reason));
  }
}
