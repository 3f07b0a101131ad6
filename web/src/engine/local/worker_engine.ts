import { decodeTicks } from "../../wire/ticks.ts";
import { type Ask, type Engine, type EngineListener, Pending, type Reply, type Triple } from "../engine.ts";
import type { FromWorker, ToWorker } from "./core.ts";

/** The part of a Worker that the engine uses; tests replace it. */
export interface WorkerPort {
  onmessage: ((event: MessageEvent<FromWorker>) => void) | null;
  onerror: ((event: ErrorEvent) => void) | null;
  postMessage(data: ToWorker): void;
  terminate(): void;
}

/** The core in WebAssembly in a worker: an engine for a page without a server. */
export class WorkerEngine implements Engine {
  readonly studio = false;
  private readonly pending = new Pending();
  private worker: WorkerPort | null = null;
  private listener: EngineListener | null = null;

  /** base: the URL of the static folder. */
  constructor(
    private readonly base: string,
    private readonly open: () => WorkerPort = () =>
      new Worker(new URL("./worker.ts", import.meta.url), { type: "module" }),
  ) {}

  start(listener: EngineListener): void {
    this.listener = listener;
    listener.connection({ state: "connecting", attempt: 1 });
    this.worker = this.open();
    this.worker.onmessage = ({ data }) => this.take(data);
    this.worker.onerror = (event) => this.fail(event.message || "the worker cannot start");
    this.post({ start: this.base });
    if (document.visibilityState === "hidden") this.tellVisible();
    document.addEventListener("visibilitychange", this.tellVisible);
  }

  stop(): void {
    document.removeEventListener("visibilitychange", this.tellVisible);
    this.listener = null;
    this.worker?.terminate();
    this.worker = null;
    this.pending.rejectAll("the page has ended the run");
  }

  ask(request: Ask): Promise<Reply> {
    if (!this.worker) return Promise.reject(new Error("The core does not run in this page now."));
    const { id, reply } = this.pending.add();
    this.post({ id, ask: request });
    return reply;
  }

  target(run: number, position: Triple, axis: Triple, buttons = 0): void {
    this.post({ run, position, axis, buttons });
  }

  private readonly tellVisible = (): void => this.post({ visible: document.visibilityState === "visible" });

  private post(data: ToWorker): void {
    this.worker?.postMessage(data);
  }

  private take(data: FromWorker): void {
    if ("frame" in data) this.listener?.ticks(decodeTicks(data.frame));
    else if ("reply" in data) this.pending.settle(data.reply);
    else if ("failed" in data) this.fail(data.failed);
    else if (data.message.kind !== "reply") {
      if (data.message.kind === "hello") this.listener?.connection({ state: "open" });
      this.listener?.message(data.message);
    }
  }

  private fail(reason: string): void {
    this.worker?.terminate();
    this.worker = null;
    this.pending.rejectAll(reason);
    this.listener?.connection({ state: "refused", reason });
  }
}
