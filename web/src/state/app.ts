import type { Ask, Connection, Engine, Reply } from "../engine/engine.ts";
import { errorText } from "../format.ts";
import { ticksCame } from "../frames.ts";
import { Api } from "../wire/api.ts";
import type {
  Control,
  EstimateMessage,
  ExerciseStatus,
  FaultMessage,
  GoalLine,
  Hello,
  LabComparison,
  Message,
  RecordingStatus,
  SittingMessage,
  Status,
} from "../wire/messages.ts";
import type { TickBatch } from "../wire/ticks.ts";
import { frozenCopy } from "./frozen.ts";
import { Signal } from "./signal.ts";
import { Source } from "./source.ts";

/** The place that an exercise asks to reach, below the first surface, m. The bottom may be infinite. */
export interface Goal {
  readonly name: string;
  readonly top: number;
  readonly bottom: number;
  /** The line that the point must meet. */
  readonly line: GoalLine | null;
}

const LIVE_TICKS = 1 << 17; // 81.9 s at 1600 Hz

/** The state of the page. Panels read it, watch it, and send requests through it. */
export class App {
  readonly connection = new Signal<Connection>({ state: "connecting", attempt: 1 });
  readonly hello = new Signal<Hello | null>(null);
  readonly control = new Signal<Control>({ kind: "control", holder: null, you: false, hand: null });
  readonly status = new Signal<Status | null>(null);
  readonly fault = new Signal<FaultMessage | null>(null);
  /** The live estimate; null while it is off. */
  readonly estimate = new Signal<EstimateMessage | null>(null);
  readonly recording = new Signal<RecordingStatus | null>(null);
  readonly exercise = new Signal<ExerciseStatus | null>(null);
  /** A participant's session: nothing else is shown. */
  readonly sitting = new Signal<SittingMessage | null>(null);
  /** What the running exercise asks to reach; null without one, and in a blind one. */
  readonly goal = new Signal<Goal | null>(null);
  /** The number of the live run. */
  readonly run = new Signal(0);
  /** Sentences for the user, the last first. */
  readonly notices = new Signal<readonly string[]>([]);
  readonly live = new Source("live", true, LIVE_TICKS);
  /** What the panels draw. */
  readonly source = new Signal<Source>(this.live);
  /** An earlier run laid over the plots. */
  readonly overlay = new Signal<Source | null>(null);
  /** Several runs whose mean is laid over the plots. */
  readonly comparison = new Signal<LabComparison | null>(null);

  constructor(
    readonly engine: Engine,
    /** Files: scenes, recordings, results. */
    readonly api: Api = new Api(""),
  ) {}

  start(): void {
    this.engine.start({
      connection: (now) => {
        this.connection.value = now;
      },
      message: (message) => this.take(message),
      ticks: (batch) => this.takeTicks(batch),
    });
  }

  /** Whether a blind exercise runs: then nothing may tell a depth. */
  get blind(): boolean {
    const now = this.exercise.value;
    return now?.running === true && now.blind === true;
  }

  /** Sends a request, and shows the reason if it is refused. */
  async ask(request: Ask): Promise<Reply | null> {
    try {
      const reply = await this.engine.ask(request);
      if (!reply.ok && reply.problems.length === 0) this.notify(reply.text || "refused");
      return reply;
    } catch (error) {
      this.notify(errorText(error));
      return null;
    }
  }

  /** Shows the live run's last ticks while the run goes on. */
  pause(): void {
    if (this.source.value.live) this.source.value = frozenCopy(this.live);
  }

  /** Shows the live run, at its last tick. */
  goLive(): void {
    this.source.value = this.live;
  }

  /** Adds a notice, the newest first. */
  notify(text: string): void {
    this.notices.value = [text, ...this.notices.value].slice(0, 50);
  }

  private takeTicks(batch: TickBatch): void {
    this.live.history.push(batch);
    ticksCame();
  }

  private take(message: Exclude<Message, Reply>): void {
    switch (message.kind) {
      case "hello":
        this.hello.value = message;
        break;
      case "scene":
        if (message.new_run) {
          this.live.history.clear(message.scene.membranes.length);
          this.live.events.value = [];
          this.live.punctures.value = [];
          this.live.pointed.value = null;
        }
        this.run.value = message.run;
        this.live.scene.value = message.scene;
        this.live.laws.value = message.scene.laws;
        break;
      case "laws":
        this.live.laws.value = message.laws;
        break;
      case "control":
        this.control.value = message;
        break;
      case "status":
        this.status.value = message;
        break;
      case "fault":
        this.fault.value = message.reason ? message : null;
        break;
      case "event":
        this.live.events.value = [...this.live.events.value, message].slice(-500);
        break;
      case "estimate":
        this.estimate.value = message.on ? message : null;
        if (message.found.length > 0) {
          const ticks = message.found.map(({ tick }) => tick);
          this.live.punctures.value = [...this.live.punctures.value, ...ticks].slice(-500);
        }
        break;
      case "recording":
        this.recording.value = message.name ? message : null;
        break;
      case "exercise":
        this.exercise.value = message;
        break;
      case "sitting":
        this.sitting.value = message;
        break;
      case "notice":
        this.notify(message.text);
        break;
    }
  }
}

/** An object that several panels share: the first panel that asks creates it. */
export function onePerApp<T>(make: (app: App) => T): (app: App) => T {
  const made = new WeakMap<App, { readonly it: T }>();
  return (app) => {
    let kept = made.get(app);
    if (!kept) {
      kept = { it: make(app) };
      made.set(app, kept);
    }
    return kept.it;
  };
}
