import { type Ask, DONE, type Engine, type EngineListener, type Reply, type Triple } from "../../src/engine/engine.ts";
import type { MembraneEvent, Spread } from "../../src/wire/messages.ts";
import type { FloatColumn, TickBatch } from "../../src/wire/ticks.ts";
import { rowWidth } from "../../src/wire/ticks.ts";
import { type FakeMembrane, fakeMembranes, fakeScene } from "./fake_model.ts";
import { LIMITS } from "./limits.ts";

const RATE = 1600;
const COLUMNS = [
  "time", "position", "axis", "tip", "model_force", "force", "ceiling", "depth", "axial_force",
  "lower", "upper", "proxy", "direction",
] as const; // biome-ignore format: a table

/** An engine without a server: a hand that strokes through three membranes at 1600 Hz. For looking at the page only. */
export class FakeEngine implements Engine {
  readonly studio = true;
  readonly membranes: FakeMembrane[];
  /** Adds the other solver's force. */
  compare = false;
  private tick = 0;
  private listener: EngineListener | null = null;
  private timer = 0;

  /** prefill: s of run that are there at once. */
  constructor(
    private readonly prefill: number,
    stiffer = 1,
  ) {
    this.membranes = fakeMembranes(stiffer);
  }

  start(listener: EngineListener): void {
    this.listener = listener;
    listener.connection({ state: "open" });
    listener.message({
      kind: "hello",
      protocol: 1,
      version: "0.0.0",
      viewer: 1,
      device: {
        backend: "simulated",
        model: "fake",
        simulated: true,
        has_orientation: true,
        max_force: 3.3,
        rate: RATE,
      },
      limits: LIMITS,
      scenes: [],
      exercises: [],
      second_device: "",
      figures: false,
    });
    listener.message({ kind: "scene", scene: fakeScene(this.membranes), new_run: true, run: 0 });
    for (let done = 0; done < this.prefill * RATE; done += 1600) this.make(1600);
    const began = performance.now() - (this.tick / RATE) * 1e3;
    const go = (): void => {
      const due = Math.floor(((performance.now() - began) / 1e3) * RATE) - this.tick;
      if (due > 0) this.make(Math.min(due, 4800));
    };
    this.timer = window.setInterval(go, 1000 / 60);
    window.setInterval(() => this.health(), 250);
  }
  stop(): void {
    window.clearInterval(this.timer);
  }
  ask(request: Ask): Promise<Reply> {
    if (request.do === "compare") this.compare = request.on;
    return Promise.resolve({ kind: "reply", id: 0, ...DONE });
  }
  target(_run: number, _position: Triple, _axis: Triple): void {}

  /** Where the simulated hand is, m along -y: strokes of 5 s, with a little tremor. */
  private hand(time: number): number {
    const stroke = time % 5;
    const way = stroke < 3 ? stroke / 3 : 1 - (stroke - 3) / 2;
    const smooth = way * way * (3 - 2 * way);
    return -5e-3 + 19e-3 * smooth + 3e-5 * Math.sin(9 * 2 * Math.PI * time);
  }

  private make(count: number): void {
    const m = this.membranes.length;
    const floats = {} as Record<Exclude<FloatColumn, "other_force">, Float32Array>;
    for (const name of COLUMNS) floats[name] = new Float32Array(count * rowWidth(name, m));
    const bytes = {
      state: new Uint8Array(count),
      fault: new Uint8Array(count),
      limit: new Uint8Array(count),
      phase: new Uint8Array(count * m),
    };
    const other = this.compare ? new Float32Array(3 * count) : null;
    const firstTick = this.tick;
    const events: MembraneEvent[] = [];
    for (let i = 0; i < count; i++, this.tick++) {
      const time = this.tick / RATE;
      const p = this.hand(time);
      let sum = 0;
      this.membranes.forEach((membrane, k) => {
        const before = { q: membrane.q, force: membrane.force, phase: membrane.phase };
        membrane.step(p - membrane.place);
        const at = i * m + k;
        floats.depth[at] = membrane.q;
        floats.axial_force[at] = membrane.force;
        floats.lower[at] = membrane.lower(membrane.q);
        floats.upper[at] = membrane.upper(membrane.q);
        floats.proxy[3 * at + 1] = -membrane.q - membrane.place;
        floats.direction.set(membrane.phase ? [0, -1, 0] : [Number.NaN, Number.NaN, Number.NaN], 3 * at);
        bytes.phase[at] = membrane.phase;
        sum += membrane.force;
        const happened = (what: MembraneEvent["what"]): void => {
          const tick = this.tick;
          const [a, b] = [before.force, membrane.force];
          const drop = Math.abs(a) - Math.abs(b);
          events.push({
            kind: "event", what, membrane: k, name: membrane.name, tick, time, depth: membrane.q,
            force_before: a, force_after: b, drop,
          }); // biome-ignore format: one line
        };
        if (before.phase === 0 && membrane.phase) happened("touch");
        if (before.phase && membrane.phase === 0) happened("out");
        if (before.q <= membrane.tipLength && membrane.q > membrane.tipLength) happened("pop");
      });
      const state = time < 1 ? 0 : time < 1.6 ? 1 : time % 31 > 29.5 ? 3 : 2;
      floats.time[i] = (this.tick - firstTick) / RATE;
      floats.axis.set([0, -1, 0], 3 * i);
      floats.position[3 * i + 1] = -p;
      floats.tip[3 * i + 1] = -p;
      floats.model_force[3 * i + 1] = -sum;
      floats.force[3 * i + 1] = state === 2 ? -sum : 0;
      floats.ceiling[i] = 3.3;
      bytes.state[i] = state;
      if (other)
        other[3 * i + 1] = -sum * (this.membranes.some((one) => one.phase === 2) && this.tick % 2 ? 1.12 : 0.98);
    }
    this.listener?.ticks({
      firstTick,
      firstTime: firstTick / RATE,
      run: 0,
      lost: 0,
      count,
      membranes: m,
      floats,
      bytes,
      otherForce: other,
    } satisfies TickBatch);
    for (const event of events) this.listener?.message(event);
  }

  private health(): void {
    const spread = (middle: number, width: number): Spread => {
      const edges = Array.from({ length: 41 }, (_, i) => 1e-6 * 10 ** (i / 10));
      const counts = edges.slice(1).map((edge) => {
        const z = Math.log10(edge / middle) / width;
        return Math.floor(this.tick * 0.1 * Math.exp((-z * z) / 2));
      });
      return { p50: middle, p99: middle * 1.07, p99_9: middle * 1.4, largest: middle * 2.3, edges, counts };
    };
    this.listener?.message({
      kind: "status",
      ticks: this.tick,
      late: 3,
      lost: 0,
      period: spread(625e-6, 0.06),
      compute: spread(9e-6, 0.15),
      viewers: 2,
      dropped: 0,
      armed: true,
      hand: "strokes",
      compare: this.compare,
      statements: ["real-time priority was not granted: run punctura devices --help", "memory is locked"],
      second: null,
    });
  }
}
