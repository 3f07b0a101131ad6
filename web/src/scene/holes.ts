import { Vector3 } from "three";
import type { Source } from "../state/source.ts";
import type { MembraneView } from "../wire/messages.ts";
import { MM } from "./moment.ts";

/** A hole from a needle: its tick, its place on the undeformed front face (mm) and its direction. */
export interface Hole {
  readonly tick: number;
  readonly front: Vector3;
  readonly direction: Vector3;
}

/**
 * The holes in each membrane, from the source's pops. A hole's place is read once, while its tick is still in the
 * history, and kept until the run ends.
 */
export class Holes {
  private holes: Hole[][] = [];
  private seen = 0;
  private source: Source | null = null;
  private generation = -1;

  read(source: Source, membranes: readonly MembraneView[]): void {
    const events = source.events.value;
    if (source !== this.source || source.history.generation !== this.generation || events.length === 0) {
      this.source = source;
      this.generation = source.history.generation;
      this.holes = [];
      this.seen = -1;
    }
    for (let i = events.length - 1; i >= 0 && events[i]!.tick > this.seen; i--) {
      const event = events[i]!;
      const membrane = membranes[event.membrane];
      const { first, end } = source.history;
      if (event.what !== "pop" || !membrane || event.tick < first || event.tick >= end) continue;
      const hole = holeAt(source, event.tick, event.membrane, membrane);
      if (hole) this.add(event.membrane, hole, 0.2);
    }
    const last = events.at(-1);
    if (last && last.tick < source.history.end) this.seen = Math.max(this.seen, last.tick);
  }

  /** The holes that membrane `index` had at `tick`, oldest first. */
  of(index: number, tick: number): readonly Hole[] {
    return (this.holes[index] ?? []).filter((hole) => hole.tick <= tick);
  }

  private add(index: number, hole: Hole, near: number): void {
    const there = this.holes[index] ?? [];
    this.holes[index] = there;
    if (there.some((other) => other.front.distanceTo(hole.front) < near && other.tick <= hole.tick)) return;
    there.push(hole);
    there.sort((a, b) => a.tick - b.tick);
    if (there.length > 40) there.shift();
  }
}

function holeAt({ history }: Source, tick: number, index: number, membrane: MembraneView): Hole | null {
  const proxy = new Vector3().fromArray(history.row("proxy", tick), 3 * index).multiplyScalar(MM);
  const direction = new Vector3().fromArray(history.row("direction", tick), 3 * index);
  const normal = new Vector3(...membrane.inward_normal);
  const slope = direction.dot(normal);
  if (!(slope > 0.05)) return null;
  const depth =
    proxy
      .clone()
      .sub(new Vector3(...membrane.point).multiplyScalar(MM))
      .dot(normal) / slope;
  return { tick, front: proxy.addScaledVector(direction, -depth), direction };
}
