import type { Triple } from "../engine/engine.ts";
import { signedSize } from "../plots/gather.ts";
import { Polyline } from "../plots/kit/polyline.ts";
import type { History } from "../state/history.ts";
import { feltDrop, scaleOf } from "../state/scale.ts";
import type { Source } from "../state/source.ts";
import type { MembraneEvent, SceneView } from "../wire/messages.ts";
import { codeOf } from "../wire/ticks.ts";

const OUTSIDE = codeOf("phase", "outside");
const MM = 1e3;
export const ABOVE_MM = 3; // in front of the skin there is nothing to feel
const MOST = 20_000; // points; with more, the steps become larger
const SEEN = 0.05; // of the greatest force: a smaller drop is not seen in the curve, and has no mark
const FINEST = { depth: 0.01, force: 0.002 } as const; // mm, N

/** A pop at its place on the curve. */
interface PopMark {
  readonly event: MembraneEvent;
  /** Of the tip below the skin, mm, and the felt force before it, N. */
  readonly depth: number;
  readonly force: number;
  /** Of the tip, m. */
  readonly place: Triple;
}

/** The depth of the tip below the skin, mm, and the felt force, N: negative if it pulls the needle in. */
export interface Felt {
  readonly depth: number;
  readonly force: number;
}

export function feltAt(history: History, scene: SceneView, tick: number): Felt {
  const first = scene.membranes[0];
  const tip = history.row("tip", tick);
  let depth = 0;
  for (let k = 0; k < 3; k++) depth += (first?.inward_normal[k] ?? 0) * (tip[k]! - (first?.point[k] ?? 0));
  return { depth: depth * MM, force: signedSize(history, "force", history.slot(tick)) };
}

/** The greatest felt force that a law of the scene has in a tick, N. */
export const strongestAt = (source: Source, tick: number | null): number =>
  Math.max(0.2, ...source.laws.value.flatMap(({ lower }) => lower.map(Math.abs))) * scaleOf(source, tick);

/** The source that has the whole attempt. Around a pop it is another one; a moment of a recording has all its ticks. */
export const wholeOf = (source: Source): Source => (source.excerpt?.event && source.excerpt.of) || source;

/**
 * The felt force against the depth of the tip, for the whole attempt. The ticks themselves are kept for some time
 * only; this keeps each point that differs from the one before, in steps that are too small to be seen.
 */
export class Attempt {
  /** xs: forces, N; ys: depths, mm. NaN is a gap. */
  readonly path = new Polyline();
  pops: PopMark[] = [];
  /** The greatest force, N, and depth, mm. */
  most = 0;
  deepest = 0;
  /** Increases when the curve is another one and not only longer. */
  generation = 0;
  private next = 0; // tick
  private run = -1; // the history's generation
  private seen = new WeakSet<MembraneEvent>();
  private step = 1; // in units of FINEST
  private waits = false; // until the needle is out of the tissue
  private last: readonly [depth: number, force: number] = [Number.NaN, Number.NaN]; // in steps

  constructor(readonly source: Source) {}

  /** Begins anew, as soon as the tip is outside the tissue. */
  begin(): void {
    this.clear();
    this.waits = true;
    this.next = this.source.history.end;
    for (const event of this.source.events.value) this.seen.add(event);
  }

  private clear(): void {
    this.path.clear();
    this.pops = [];
    this.most = this.deepest = 0;
    this.step = 1;
    this.last = [Number.NaN, Number.NaN];
    this.generation++;
  }

  /** Takes all ticks and events since the last call. Returns whether the curve has changed. */
  follow(): boolean {
    const { history, scene, events } = this.source;
    if (!scene.value || history.membranes !== scene.value.membranes.length) return false;
    const before = this.path.count + this.pops.length + this.generation;
    if (history.generation !== this.run) {
      if (this.run !== -1) this.clear();
      this.run = history.generation;
      this.next = history.first;
      this.waits = false;
    }
    if (this.next < history.first) {
      this.path.gap(); // the page was too slow for these ticks
      this.next = history.first;
    }
    for (; this.next < history.end; this.next++) this.take(history, scene.value, this.next);
    for (const event of events.value) if (!this.seen.has(event)) this.mark(history, scene.value, event);
    return this.path.count + this.pops.length + this.generation !== before;
  }

  private take(history: History, scene: SceneView, tick: number): void {
    if (this.waits && history.byteRow("phase", tick).some((phase) => phase !== OUTSIDE)) return;
    this.waits = false;
    const { depth, force } = feltAt(history, scene, tick);
    if (!(depth > -ABOVE_MM) || !Number.isFinite(force)) {
      this.path.gap();
      this.last = [Number.NaN, Number.NaN];
      return;
    }
    this.add(force, depth);
    if (this.path.count > MOST) this.coarsen();
  }

  private add(force: number, depth: number): void {
    const down = Math.round(depth / FINEST.depth / this.step);
    const strong = Math.round(force / FINEST.force / this.step);
    if (down === this.last[0] && strong === this.last[1]) return;
    this.last = [down, strong];
    this.path.add(force, depth);
    this.most = Math.max(this.most, force);
    this.deepest = Math.max(this.deepest, depth);
  }

  /** Twice the steps: what is left differs by one step at most from what was there. */
  private coarsen(): void {
    const { xs, ys, count } = this.path;
    const [forces, depths] = [xs.slice(0, count), ys.slice(0, count)];
    this.path.clear();
    this.generation++;
    this.step *= 2;
    this.last = [Number.NaN, Number.NaN];
    for (let i = 0; i < count; i++) {
      if (Number.isNaN(depths[i]!)) this.path.gap();
      else this.add(forces[i]!, depths[i]!);
    }
  }

  private mark(history: History, scene: SceneView, event: MembraneEvent): void {
    const { what, tick } = event;
    if (tick >= history.end) return; // its tick comes later
    this.seen.add(event);
    if (what !== "pop" || tick < history.first || this.waits) return;
    const drop = feltDrop(history, event);
    if (drop !== null && drop < SEEN * strongestAt(this.source, tick)) return;
    const { depth } = feltAt(history, scene, tick);
    const { force } = feltAt(history, scene, Math.max(history.first, tick - 1));
    const [x, y, z] = history.row("tip", tick);
    this.pops = [...this.pops, { event, depth, force, place: [x!, y!, z!] }];
  }
}
