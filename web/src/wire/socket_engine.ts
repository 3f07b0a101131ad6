import type { Ask, Engine, EngineListener, Reply, Triple } from "../engine/engine.ts";

/** The studio's server, over a WebSocket. */
export class SocketEngine implements Engine {
  constructor(_page: Location) {}
  start(_listener: EngineListener): void {}
  stop(): void {}
  ask(_request: Ask): Promise<Reply> {
    return Promise.reject(new Error("not connected"));
  }
  target(_position: Triple, _axis: Triple, _buttons = 0): void {}
}
