import type { Message, Request } from "../wire/messages.ts";
import type { TickBatch } from "../wire/ticks.ts";

/** The state of the connection to the source of ticks. */
export type Connection =
  | { readonly state: "connecting"; readonly attempt: number }
  | { readonly state: "open" }
  | { readonly state: "lost"; readonly reason: string; readonly retryInMs: number }
  | { readonly state: "refused"; readonly reason: string };

export type Reply = Extract<Message, { kind: "reply" }>;
export type Answer = Omit<Reply, "kind" | "id">;
export const DONE: Answer = { ok: true, text: "", problems: [], data: {} };
type Without<T> = T extends { id: number } ? Omit<T, "id"> : never;
/** A request as a panel writes it; the engine numbers it. */
export type Ask = Without<Request>;
export type Triple = readonly [number, number, number];

/** What an engine sends to the page. Batches come in the order of ticks, and contain every tick. */
export interface EngineListener {
  connection(now: Connection): void;
  message(message: Exclude<Message, Reply>): void;
  ticks(batch: TickBatch): void;
}

/**
 * A source of ticks: the studio's server over a socket, or the core as WebAssembly in a worker of the page.
 * SI units; axes right-handed, x right, y up, z towards the user.
 */
export interface Engine {
  /** Whether a studio's server is behind it: devices, recordings and results on its disk, computations in Python. */
  readonly studio: boolean;
  start(listener: EngineListener): void;
  stop(): void;
  /** Resolves with the reply, also with a refusal (`ok` false); rejects if the connection is lost before it. */
  ask(request: Ask): Promise<Reply>;
  /**
   * Moves the simulated hand in this run: position, m, and direction of the stylus. Only the last target of an
   * animation frame is sent. The server ignores targets of another run.
   */
  target(run: number, position: Triple, axis: Triple, buttons?: number): void;
  /** Says that this page can move the hand. Only a studio wants to know. */
  awake?(): void;
}

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
