import { errorText } from "../../format.ts";
import type { EstimateMessage, Message, SceneView } from "../../wire/messages.ts";
import { codeOf, decodeTicks, wordsOf } from "../../wire/ticks.ts";
import { type Answer, type Ask, DONE, type Reply, type Triple } from "../engine.ts";
import { BlockClock } from "./clock.ts";
import { IN_CONTROL, type LiveRun, type Punctura, type StudioData, type Tables } from "./core.ts";
import { withDefaults } from "./defaults.ts";
import { tomlOf } from "./files.ts";
import { EXERCISE_FILE, NEEDS_STUDIO, statusOf } from "./status.ts";

const THUMB_MS = 1000; // a page that still pushes the plunger says so more often
const NO_FAULT = codeOf("fault", "none");
const FAULTS = wordsOf("fault");

/** Where messages and frames go. */
export interface Out {
  message(message: Exclude<Message, Reply>): void;
  frame(frame: ArrayBuffer): void;
}

/** Refused, with a sentence. */
class NotNow extends Error {}

/** What the studio's server does, as far as a page can do it alone. It runs in a worker; the model is the core's. */
export class LocalStudio {
  private run!: LiveRun;
  private tables: Tables = {};
  private number = -1;
  private fault = NO_FAULT;
  private withheld = false; // force, until a person turns it on: it was turned off, or there was a fault
  private armed = false;
  private comparing = false;
  private estimating = false;
  private ticks = 0;
  private busyMs = 0;
  private hasSyringe = false;
  private thumbEnds = Number.POSITIVE_INFINITY;
  private clock = new BlockClock(1);

  /** schema: of a scene file. now: ms, on a clock that never goes back. */
  constructor(
    private readonly core: Punctura,
    private readonly data: StudioData,
    private readonly schema: Tables,
    private readonly out: Out,
    private readonly now: () => number,
  ) {}

  /** Sends what a new page needs, and begins the first run. */
  start(): void {
    const { version, protocol, scenes, first } = this.data;
    this.out.message({
      kind: "hello",
      protocol,
      version,
      viewer: 1,
      ...this.core.LiveRun.about,
      scenes: scenes.map(({ name, title }) => ({ name, title })),
      exercises: [],
      second_device: "",
      figures: false,
    });
    this.out.message(IN_CONTROL);
    this.load(first);
  }

  /** A refusal has the sentence or the problems. */
  ask(request: Ask): Answer {
    try {
      return { ...DONE, ...this.obey(request) };
    } catch (error) {
      if (error instanceof NotNow) return { ...DONE, ok: false, text: error.message };
      return refusal(error);
    }
  }

  target(run: number, position: Triple, axis: Triple, buttons: number): void {
    if (run === this.number) this.run.target(position, axis, buttons);
  }

  /** Makes the ticks that are due. */
  turn(): void {
    const now = this.now();
    if (now >= this.thumbEnds) this.push(0);
    const count = this.clock.due(now);
    if (count === 0) return;
    this.ticks += count;
    const frame = this.run.advance(count);
    this.busyMs += this.now() - now;
    const { bytes, firstTick } = decodeTicks(frame);
    const faults = bytes.fault.slice(); // a frame that was sent belongs to the page
    this.out.frame(frame);
    this.watchFault(faults, firstTick);
    for (const message of this.run.messages()) this.out.message(message);
  }

  /** Nobody looks at the page: no ticks until the next turn, and none of them counts as left out. */
  sleep(): void {
    this.clock.sleep();
  }

  tellStatus(): void {
    const { ticks, busyMs, armed, comparing: compare } = this;
    const hand = this.run.strokesNow ? "strokes" : "target";
    this.out.message(statusOf({ ticks, busyMs, leftOut: this.clock.leftOut, armed, hand, compare }));
  }

  private obey(request: Ask): Partial<Answer> {
    switch (request.do) {
      case "take_control":
        this.out.message(IN_CONTROL);
        return DONE;
      case "arm":
        this.run.arm();
        this.withheld = this.fault !== NO_FAULT; // a fault ends by a reset only
        this.armed = !this.withheld;
        return DONE;
      case "pause":
        this.run.pause();
        this.withhold();
        return DONE;
      case "reset":
        this.run.reset();
        this.withhold();
        return DONE;
      case "strokes":
        this.run.strokes(Math.min(60, Math.max(0.5, request.period ?? 4)));
        return DONE;
      case "push_plunger":
        if (!this.hasSyringe) throw new NotNow("the scene has no syringe");
        this.push(request.force);
        return DONE;
      case "trip_fault":
        this.run.trip();
        return DONE;
      case "compare":
        this.comparing = request.on;
        this.run.compare(request.on);
        return DONE;
      case "estimate":
        this.estimating = request.on;
        this.run.estimate(request.on);
        if (!request.on) this.out.message(noEstimate());
        return DONE;
      case "edit":
        return this.edit(request.tables);
      case "load":
        return this.load(request.scene);
      case "load_text":
        return this.loadText(request.toml);
      default:
        throw new NotNow(NEEDS_STUDIO);
    }
  }

  private load(name: string): Partial<Answer> {
    const ready = this.data.scenes.find((scene) => scene.name === name);
    if (!ready) throw new NotNow(`there is no ready scene ${name}`);
    this.begin(tomlOf(ready.tables), ready.tables);
    return DONE;
  }

  private loadText(toml: string): Partial<Answer> {
    const tables = this.core.tablesOf(toml) ?? {};
    if ("goal" in tables && !("membrane" in tables)) throw new NotNow(EXERCISE_FILE);
    this.begin(toml, tables);
    return DONE;
  }

  /** Starts a new run. If the scene has problems, the present run goes on, and the error is thrown. */
  private begin(toml: string, tables: Tables): void {
    const before = this.run as LiveRun | undefined;
    this.run = new this.core.LiveRun(toml, { number: this.number + 1, ...(before && { after: before }) });
    before?.free();
    this.number += 1;
    this.tables = withDefaults(tables, this.schema);
    this.clock = new BlockClock(this.run.rate);
    this.ticks = this.busyMs = 0;
    this.fault = NO_FAULT;
    this.thumbEnds = Number.POSITIVE_INFINITY;
    if (this.comparing) this.run.compare(true);
    if (this.estimating) this.run.estimate(true);
    this.armed = !this.withheld;
    if (this.armed) this.run.arm();
    this.out.message(noFault());
    this.tellScene(true);
    if (!this.armed) this.out.message({ kind: "notice", text: this.data.still_off });
  }

  private edit(tables: Tables): Partial<Answer> {
    this.turn(); // the page gets the ticks of the old scene first
    this.run.exchange(tomlOf(tables));
    this.tables = withDefaults(tables, this.schema);
    this.tellScene(false);
    const rate = (this.tables.servo as { rate_hz?: number } | undefined)?.rate_hz ?? this.run.rate;
    return rate === this.run.rate ? DONE : { text: "the new rate takes effect in the next run" };
  }

  private tellScene(newRun: boolean): void {
    const scene = { ...this.run.scene, tables: this.tables } as SceneView;
    this.hasSyringe = scene.syringe !== null;
    this.out.message({ kind: "scene", scene, new_run: newRun, run: this.number });
  }

  private push(force: number): void {
    this.run.pushPlunger(force);
    this.thumbEnds = force > 0 ? this.now() + THUMB_MS : Number.POSITIVE_INFINITY;
  }

  private withhold(): void {
    this.withheld = true;
    this.armed = false;
  }

  private watchFault(faults: Uint8Array, firstTick: number): void {
    const last = faults.at(-1) ?? NO_FAULT;
    if (last === this.fault) return;
    this.fault = last;
    if (last !== NO_FAULT) this.withhold();
    const name = FAULTS[last];
    const words = name && this.data.faults[name];
    this.out.message(
      words
        ? { ...noFault(), fault: name, reason: words[0], remedy: words[1], tick: firstTick + faults.indexOf(last) }
        : noFault(),
    );
  }
}

const noFault = () =>
  ({ kind: "fault", fault: "none", reason: "", remedy: "", trouble: "", tick: null, kept: 0 }) as const;

const noEstimate = (): EstimateMessage => ({
  kind: "estimate",
  on: false,
  phase: "free",
  slope: null,
  plateau: null,
  punctures: 0,
  drop: 0,
  ignored: 0,
  found: [],
});

/** The problems of a scene, as the server would send them. */
function refusal(error: unknown): Answer {
  const found = (error as { problems?: { path: string; value: number; reason: string }[] }).problems;
  const text = errorText(error);
  if (!found?.length) return { ...DONE, ok: false, text };
  const problems = found.map(({ path, value, reason }) => ({
    path,
    value: Number.isNaN(value) ? "" : String(value),
    reason,
  }));
  return { ...DONE, ok: false, text: `${problems.length} problem${problems.length === 1 ? "" : "s"}`, problems };
}
