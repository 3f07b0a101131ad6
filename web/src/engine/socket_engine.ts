import { errorText } from "../format.ts";
import { Api, ApiError, type Fetch } from "../wire/api.ts";
import { framesOf } from "../wire/length_prefixed.ts";
import type { Message } from "../wire/messages.ts";
import { decodeTicks, type TickBatch } from "../wire/ticks.ts";
import { type Ask, type Engine, type EngineListener, Pending, type Reply, type Triple } from "./engine.ts";

const PROTOCOL = "punctura.v1";
/** A browser hides why a socket was refused; this address gives the same refusal with its reason. */
const ACCESS = "/api/access";
/** Statuses for which another attempt is useless: no token, a foreign page, a wrong host name. */
const REFUSED = [401, 403, 421];
const SETTLED_MS = 2000;
const TOOK = JSON.stringify({ do: "took" });

/** The environment of the engine; tests replace it. */
export interface Surroundings {
  open(url: string, protocols: string[]): WebSocket;
  /** Calls once before the next animation frame. */
  frame(call: () => void): void;
  chance(): number;
  readonly fetch: Fetch;
}

const BROWSER: Surroundings = {
  open: (url, protocols) => new WebSocket(url, protocols),
  frame: (call) => void requestAnimationFrame(call),
  chance: Math.random,
  fetch: (input, init) => fetch(input, init),
};

/** The studio's server over a WebSocket; reconnects by itself. */
export class SocketEngine implements Engine {
  readonly studio = true;
  private readonly url: string;
  private readonly api: Api;
  private readonly pending = new Pending();
  private listener: EngineListener | null = null;
  private socket: WebSocket | null = null;
  private attempt = 0;
  private opened = false;
  private retry: ReturnType<typeof setTimeout> | undefined;
  private settled: ReturnType<typeof setTimeout> | undefined;
  private nextTarget: { run: number; position: Triple; axis: Triple; buttons: number } | null = null;
  private complained = false;

  /** page: the URL of the page. token: of this run. */
  constructor(
    page: Pick<Location, "protocol" | "host">,
    private readonly token: string,
    private readonly around: Surroundings = BROWSER,
  ) {
    this.url = `${page.protocol === "https:" ? "wss" : "ws"}://${page.host}/ws`;
    this.api = new Api(token, around.fetch);
  }

  start(listener: EngineListener): void {
    this.listener = listener;
    this.connect();
  }

  stop(): void {
    this.listener = null;
    clearTimeout(this.retry);
    clearTimeout(this.settled);
    const socket = this.socket;
    this.socket = null;
    socket?.close(1000);
    this.pending.rejectAll("the page has closed the connection");
  }

  ask(request: Ask): Promise<Reply> {
    if (this.socket?.readyState !== 1) return Promise.reject(new Error("There is no connection to the studio now."));
    const { id, reply } = this.pending.add();
    this.socket.send(JSON.stringify({ ...request, id }));
    return reply;
  }

  target(run: number, position: Triple, axis: Triple, buttons = 0): void {
    const first = this.nextTarget === null;
    this.nextTarget = { run, position, axis, buttons };
    if (first) this.around.frame(() => this.sendTarget());
  }

  awake(): void {
    if (this.socket?.readyState === 1) this.socket.send(JSON.stringify({ do: "awake" }));
  }

  private sendTarget(): void {
    const target = this.nextTarget;
    this.nextTarget = null;
    if (target && this.socket?.readyState === 1) this.socket.send(JSON.stringify({ do: "target", ...target }));
  }

  private connect(): void {
    this.attempt += 1;
    this.opened = false;
    this.complained = false;
    this.listener?.connection({ state: "connecting", attempt: this.attempt });
    let socket: WebSocket;
    try {
      socket = this.around.open(this.url, [PROTOCOL, `token.${this.token}`]);
    } catch {
      this.listener?.connection({ state: "refused", reason: "the URL's token is invalid" });
      return;
    }
    this.socket = socket;
    socket.binaryType = "arraybuffer";
    // Events of a socket that was replaced or stopped are ignored.
    const mine =
      <E>(handle: (event: E) => void) =>
      (event: E) => {
        if (this.socket === socket) handle(event);
      };
    socket.onopen = mine(() => {
      this.opened = true;
      // A connection that closes soon after it opens must not reset the growing waits.
      this.settled = setTimeout(() => {
        this.attempt = 0;
      }, SETTLED_MS);
      this.listener?.connection({ state: "open" });
    });
    socket.onmessage = mine((event: MessageEvent<unknown>) => this.take(event.data));
    socket.onclose = mine((event: CloseEvent) => this.closed(event));
  }

  private closed(event: CloseEvent): void {
    this.socket = null;
    clearTimeout(this.settled);
    this.pending.rejectAll("The connection went before the studio could answer.");
    const retryInMs = waitBefore(Math.max(1, this.attempt), this.around.chance);
    const reason = event.reason || "the studio does not answer";
    this.listener?.connection({ state: "lost", reason, retryInMs });
    this.retry = setTimeout(() => this.connect(), retryInMs);
    if (!this.opened) void this.askWhy();
  }

  /** Finds out whether the studio is gone or refuses this page; after a refusal there is no further attempt. */
  private async askWhy(): Promise<void> {
    try {
      await this.api.get(ACCESS);
    } catch (error) {
      if (!(error instanceof ApiError) || !REFUSED.includes(error.status) || this.opened) return;
      clearTimeout(this.retry);
      this.socket = null;
      this.listener?.connection({ state: "refused", reason: error.message });
    }
  }

  private take(data: unknown): void {
    if (data instanceof ArrayBuffer) this.takeTicks(data);
    else if (typeof data === "string") this.takeMessage(data);
    else this.complain("a frame of an unknown type");
  }

  /** Takes a message with ticks, and asks for the next: a page that is late gets more frames in one message. */
  private takeTicks(data: ArrayBuffer): void {
    try {
      for (const batch of this.decoded(data)) this.listener?.ticks(batch);
    } finally {
      if (this.socket?.readyState === 1) this.socket.send(TOOK);
    }
  }

  private decoded(data: ArrayBuffer): TickBatch[] {
    try {
      return framesOf(data).map((frame) => decodeTicks(frame));
    } catch (error) {
      this.complain(errorText(error));
      return [];
    }
  }

  private takeMessage(text: string): void {
    const message = parseMessage(text);
    if (typeof message === "string") this.complain(message);
    else if (message.kind !== "reply") this.listener?.message(message);
    else if (!this.pending.settle(message)) this.complain(`a reply to unknown request ${message.id}`);
  }

  /** Tells the user once per connection, because the same error may come sixty times a second. */
  private complain(what: string): void {
    if (this.complained) return;
    this.complained = true;
    this.listener?.message({ kind: "notice", text: `Cannot read a message from the studio: ${what}.` });
  }
}

const FIRST_MS = 250;
const LARGEST_MS = 8000;

/**
 * The wait before attempt n, ms (1 is the first after a loss): doubles, with random jitter so that pages do not
 * all connect at once.
 */
function waitBefore(attempt: number, chance: () => number = Math.random): number {
  const wait = Math.min(LARGEST_MS, FIRST_MS * 2 ** (attempt - 1));
  return Math.round(wait * (0.8 + 0.4 * chance()));
}

const KINDS: Readonly<Record<Message["kind"], true>> = {
  hello: true,
  scene: true,
  laws: true,
  control: true,
  status: true,
  fault: true,
  event: true,
  estimate: true,
  recording: true,
  exercise: true,
  sitting: true,
  reply: true,
  notice: true,
};

/**
 * Parses a message of the server. Returns a sentence if it is invalid. Only the kind is checked: the server defines
 * the types.
 */
function parseMessage(text: string): Message | string {
  let value: unknown;
  try {
    value = JSON.parse(text);
  } catch {
    return "a message that is no JSON";
  }
  if (typeof value !== "object" || value === null || !("kind" in value)) return "a message without a kind";
  if (typeof value.kind !== "string" || !Object.hasOwn(KINDS, value.kind)) {
    return `a message of an unknown kind, ${JSON.stringify(value.kind)}`;
  }
  return value as Message;
}
