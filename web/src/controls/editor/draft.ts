import type { App } from "../../state/app.ts";
import { Signal } from "../../state/signal.ts";
import type { LawCurve, ProblemPart, SceneView } from "../../wire/messages.ts";
import { getAt, type Path, pathText, same, setAt, type Tables } from "./tables.ts";
import { Undo } from "./undo.ts";

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

/**
 * The scene in the editor. It can be ahead of the server's scene, which makes the force. Every change sends the whole
 * scene; a newer change replaces one that waits. A refused change stays here with its problems until it is corrected.
 */
export class Draft {
  readonly tables: Signal<Tables>;
  readonly problems = new Signal<readonly ProblemPart[]>([]);
  /** The laws before the present change, drawn behind the new ones. */
  readonly before = new Signal<readonly LawCurve[]>([]);
  /** Which of undo, redo and reset are possible. */
  readonly can = new Signal({ undo: false, redo: false, reset: false });

  private readonly steps: Undo<Tables>;
  private readonly sender: LastWins<Tables, readonly ProblemPart[]>;
  private loaded: Tables = {};
  private seen = false;

  constructor(private readonly app: App) {
    this.tables = new Signal<Tables>({});
    this.steps = new Undo<Tables>({});
    this.sender = new LastWins(
      (tables) => this.send(tables),
      (problems, _tables, last) => {
        if (last) this.problems.value = problems;
      },
    );
    app.live.scene.watch((scene) => scene && this.take(scene));
  }

  /** Sets a value. Quick changes of the same path, as in a drag, are one step of undo. */
  set(path: Path, value: unknown): void {
    this.change(setAt(this.tables.value, path, value), pathText(path));
  }

  at(path: Path): unknown {
    return getAt(this.tables.value, path);
  }

  change(tables: Tables, topic = ""): void {
    if (same(tables, this.tables.value)) return;
    if (this.steps.step(tables, topic, performance.now())) this.before.value = this.app.live.laws.value;
    this.show(tables);
    this.sender.give(tables);
  }

  undo(): void {
    if (this.steps.canUndo) this.goTo(this.steps.undo());
  }
  redo(): void {
    if (this.steps.canRedo) this.goTo(this.steps.redo());
  }
  reset(): void {
    this.change(this.loaded);
  }

  private goTo(tables: Tables): void {
    this.before.value = this.app.live.laws.value;
    this.show(tables);
    this.sender.give(tables);
  }

  private show(tables: Tables): void {
    this.tables.value = tables;
    this.can.value = {
      undo: this.steps.canUndo,
      redo: this.steps.canRedo,
      reset: !same(tables, this.loaded),
    };
  }

  /**
   * Takes the server's scene: an echo of a change, or another scene that replaces this one. A run starts with
   * scene 0. If that equals the present scene, as at the start of a recording, the undo history stays.
   */
  private take(scene: SceneView): void {
    const other = !same(scene.tables, this.tables.value);
    if (!this.seen || (other && scene.number === 0)) {
      this.seen = true;
      this.sender.drop();
      this.problems.value = [];
      this.loaded = scene.tables;
      this.steps.forget(scene.tables);
      this.before.value = [];
      this.show(scene.tables);
    } else if (other && !this.sender.busy && this.problems.value.length === 0) {
      this.steps.replace(scene.tables);
      this.show(scene.tables);
    }
  }

  private async send(tables: Tables): Promise<readonly ProblemPart[]> {
    const reply = await this.app.ask({ do: "edit", tables });
    if (!reply) return [{ path: "", value: "", reason: "the change was not sent: no connection" }];
    if (reply.ok) return [];
    return reply.problems.length ? reply.problems : [{ path: "", value: "", reason: reply.text || "refused" }];
  }
}
