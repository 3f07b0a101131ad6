import {
  type Ask,
  DONE,
  type Engine,
  type EngineListener,
  type Reply,
  type Triple,
} from "../../../src/engine/engine.ts";
import type { LawCurve, Message, ProblemPart, SceneView } from "../../../src/wire/messages.ts";

type Table = Record<string, number>;

/**
 * An engine without a model, for the panels' tests: it takes edits as the studio does, with refusals and with laws of
 * about the right size, and keeps what it was asked.
 */
export class FakeEngine implements Engine {
  readonly studio = true;
  readonly asked: Ask[] = [];
  private listener: EngineListener | null = null;
  private number = 0;

  constructor(
    private scene: SceneView,
    /** ms that a request takes. */
    private readonly delay = 8,
  ) {}

  start(listener: EngineListener): void {
    this.listener = listener;
    listener.connection({ state: "open" });
    this.emit({ kind: "control", holder: 1, you: true, hand: null });
    this.emit({ kind: "scene", scene: this.scene, new_run: true, run: 0 });
  }
  stop(): void {}
  target(_run: number, _position: Triple, _axis: Triple): void {}

  emit(message: Exclude<Message, { kind: "reply" }>): void {
    this.listener?.message(message);
  }

  async ask(request: Ask): Promise<Reply> {
    this.asked.push(request);
    await new Promise((done) => setTimeout(done, this.delay));
    const reply = { kind: "reply", id: this.asked.length, ...DONE } as const;
    if (request.do !== "edit") return reply;
    const problems = problemsOf(request.tables);
    if (problems.length) return { ...reply, ok: false, text: "bad scene", problems };
    this.number += 1;
    this.scene = { ...this.scene, number: this.number, tables: request.tables, laws: this.laws(request.tables) };
    this.emit({ kind: "scene", scene: this.scene, new_run: false, run: 0 });
    return reply;
  }

  private laws(tables: Record<string, unknown>): LawCurve[] {
    return (tables.membrane as Table[]).map((membrane, i) => {
      const law = this.scene.laws[Math.min(i, this.scene.laws.length - 1)]!;
      const size = (membrane.friction! * (membrane.stiffness_N_per_mm! + membrane.precompression_N!)) / 0.14;
      return {
        ...law,
        name: String(membrane.name),
        lower: law.lower.map((f) => f * size),
        upper: law.upper.map((f) => f * size),
      };
    });
  }
}

function problemsOf(tables: Record<string, unknown>): ProblemPart[] {
  return (tables.membrane as Table[]).flatMap((membrane, i) =>
    membrane.friction! > 3
      ? [
          {
            path: `membrane[${i}].friction`,
            value: String(membrane.friction),
            reason: "the largest value that is allowed with this tip angle is 3.477, K06 (7)",
          },
        ]
      : [],
  );
}
