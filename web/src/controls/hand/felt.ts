import type { Source } from "../../state/source.ts";
import type { MembraneEvent } from "../../wire/messages.ts";
import { codeOf } from "../../wire/ticks.ts";

const SLIDING_IN = codeOf("phase", "sliding_in");
const SLIDING_OUT = codeOf("phase", "sliding_out");
const WINDOW_TICKS = 40; // 25 ms at 1600 Hz
const LATE_TICKS = 800; // an event can arrive shortly after its tick

/** Finds what sound and vibration present of a source, as its timeline advances: dry friction and pops. */
export class Felt {
  private source: Source | null = null;
  private generation = -1;
  private last = -1;
  private readonly known = new Map<string, number>(); // the tick of each pop;

  /** Power of dry friction at the timeline's tick, W: force times speed of the proxy in the tissue. */
  power(source: Source): number {
    const tick = source.present();
    const { history } = source;
    if (tick === null) return 0;
    const from = Math.max(history.first, tick - WINDOW_TICKS);
    const seconds = history.timeOf(tick) - history.timeOf(from);
    if (!(seconds > 0)) return 0;
    const phase = history.byteRow("phase", tick);
    const depth = history.row("depth", tick);
    const before = history.row("depth", from);
    const force = history.row("axial_force", tick);
    let sum = 0;
    for (let i = 0; i < history.membranes; i++) {
      if (phase[i] !== SLIDING_IN && phase[i] !== SLIDING_OUT) continue;
      const power = Math.abs((force[i]! * (depth[i]! - before[i]!)) / seconds);
      if (Number.isFinite(power)) sum += power;
    }
    return sum;
  }

  /** The pops since the last call; none after a jump in time or to another run. */
  pops(source: Source): MembraneEvent[] {
    const tick = source.present();
    if (tick === null) return [];
    const events = source.events.value;
    const { generation } = source.history;
    const jumped = source !== this.source || generation !== this.generation || tick < this.last;
    if (jumped) this.known.clear();
    for (const [key, popped] of this.known) if (popped < tick - LATE_TICKS) this.known.delete(key);
    const found: MembraneEvent[] = [];
    for (let i = events.length - 1; i >= 0; i--) {
      const event = events[i]!;
      if (event.tick < tick - LATE_TICKS) break;
      const key = `${event.tick} ${event.membrane} ${event.what}`;
      if (event.tick > tick || event.what !== "pop" || this.known.has(key)) continue;
      this.known.set(key, event.tick);
      if (!jumped) found.push(event);
    }
    this.source = source;
    this.generation = generation;
    this.last = tick;
    return found;
  }
}
