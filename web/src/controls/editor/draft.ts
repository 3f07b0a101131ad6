import type { App } from "../../state/app.ts";
import { Signal } from "../../state/signal.ts";
import type { LawCurve, ProblemPart, SceneView } from "../../wire/messages.ts";
import { LastWins } from "./sender.ts";
import { getAt, type Path, pathText, same, setAt, type Tables } from "./tables.ts";
import { Undo } from "./undo.ts";

/**
 * The scene as the person is writing it. It runs ahead of the scene that makes the force: each change is sent as a
 * whole, the last one wins, and one that is refused stays here with its problems until it is put right.
 */
export class Draft {
  readonly tables: Signal<Tables>;
  readonly problems = new Signal<readonly ProblemPart[]>([]);
  /** The laws before the change that is being made, to draw behind the new ones. */
  readonly before = new Signal<readonly LawCurve[]>([]);
  /** Changes whenever undo, redo or reset may have become possible or not. */
  readonly marks = new Signal({ undo: false, redo: false, reset: false });

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

  /** Puts a value in; changes of one `topic` in quick succession, as a drag makes them, are one step to undo. */
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
    this.marks.value = {
      undo: this.steps.canUndo,
      redo: this.steps.canRedo,
      reset: !same(tables, this.loaded),
    };
  }

  /**
   * The engine's scene: an echo of what was sent, or another one that takes the place of this. A run begins with
   * scene 0; one that begins with the scene that stands here, as a recording does, keeps what can be undone.
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
    if (!reply) return [{ path: "", value: "", reason: "the change has not arrived: there is no connection" }];
    if (reply.ok) return [];
    return reply.problems?.length ? reply.problems : [{ path: "", value: "", reason: reply.text || "refused" }];
  }
}
