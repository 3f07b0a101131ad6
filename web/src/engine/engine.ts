import type { Message, Request } from "../wire/messages.ts";
import type { TickBatch } from "../wire/ticks.ts";

/** How the page stands with what makes the ticks. */
export type Connection =
  | { readonly state: "connecting"; readonly attempt: number }
  | { readonly state: "open" }
  | { readonly state: "lost"; readonly reason: string; readonly retryInMs: number }
  | { readonly state: "refused"; readonly reason: string };

export type Reply = Extract<Message, { kind: "reply" }>;
type Without<T> = T extends { id: number } ? Omit<T, "id"> : never;
/** A request as a panel writes it; the engine numbers it. */
export type Ask = Without<Request>;
export type Triple = readonly [number, number, number];

/** What an engine tells the page. Batches follow one another by tick, with every tick there is. */
export interface EngineListener {
  connection(now: Connection): void;
  message(message: Exclude<Message, Reply>): void;
  ticks(batch: TickBatch): void;
}

/**
 * Whatever runs a scene: the studio's server over a socket is one, a core in WebAssembly can be another.
 * SI units; axes right-handed, x right, y up, z towards the user.
 */
export interface Engine {
  start(listener: EngineListener): void;
  stop(): void;
  /** Resolves with the reply, also with a refusal (`ok` false); rejects where the connection goes before it. */
  ask(request: Ask): Promise<Reply>;
  /**
   * Where the simulated hand shall go in this run, m, and where the stylus points. At most one a frame is sent: the last. In
   * another run it is ignored.
   */
  target(run: number, position: Triple, axis: Triple, buttons?: number): void;
}
