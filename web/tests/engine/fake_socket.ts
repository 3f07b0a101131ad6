import type { Connection, EngineListener } from "../../src/engine/engine.ts";
import { SocketEngine } from "../../src/engine/socket_engine.ts";
import type { Fetch } from "../../src/wire/api.ts";
import type { Message } from "../../src/wire/messages.ts";
import type { TickBatch } from "../../src/wire/ticks.ts";

/** A WebSocket whose other end is the test. */
class FakeSocket {
  readyState = 0;
  binaryType = "";
  readonly sent: Record<string, unknown>[] = [];
  closedWith: number | undefined;
  onopen: ((event: Event) => void) | null = null;
  onmessage: ((event: MessageEvent) => void) | null = null;
  onclose: ((event: CloseEvent) => void) | null = null;

  constructor(
    readonly url: string,
    readonly protocols: readonly string[],
  ) {}

  send(text: string): void {
    this.sent.push(JSON.parse(text) as Record<string, unknown>);
  }
  close(code?: number): void {
    this.closedWith = code;
    this.readyState = 3;
  }

  opens(): void {
    this.readyState = 1;
    this.onopen?.({} as Event);
  }
  says(data: unknown): void {
    this.onmessage?.({
      data: typeof data === "object" && !(data instanceof ArrayBuffer) ? JSON.stringify(data) : data,
    } as MessageEvent);
  }
  closes(code: number, reason = ""): void {
    this.readyState = 3;
    this.onclose?.({ code, reason } as CloseEvent);
  }
}

/** An engine, every socket it opened, and all that it told the page. */
export function bench(token = "abc", fetch: Fetch = () => Promise.reject(new TypeError("no server"))) {
  const sockets: FakeSocket[] = [];
  const frames: (() => void)[] = [];
  const connections: Connection[] = [];
  const messages: Message[] = [];
  const batches: TickBatch[] = [];
  const engine = new SocketEngine({ protocol: "http:", host: "127.0.0.1:8765" }, token, {
    open: (url, protocols) => {
      const socket = new FakeSocket(url, protocols);
      sockets.push(socket);
      return socket as unknown as WebSocket;
    },
    frame: (call) => frames.push(call),
    chance: () => 0.5,
    fetch,
  });
  const listener: EngineListener = {
    connection: (now) => connections.push(now),
    message: (message) => messages.push(message),
    ticks: (batch) => batches.push(batch),
  };
  engine.start(listener);
  const nextFrame = (): void => {
    for (const call of frames.splice(0)) call();
  };
  return { engine, sockets, connections, messages, batches, nextFrame, socket: () => sockets.at(-1)! };
}
