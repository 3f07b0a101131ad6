import { remembered } from "../../state/remembered.ts";
import { fallOf } from "../../state/scale.ts";
import type { Source } from "../../state/source.ts";
import type { MembraneEvent } from "../../wire/messages.ts";
import { codeOf } from "../../wire/ticks.ts";

/** The things to do, in their order. */
export const TASKS = ["touch", "hold", "pop", "back"] as const;

const OUTSIDE = codeOf("phase", "outside");
/** The tissue has been felt when it pushes with this share of the greatest force of its law. */
const FELT = 0.5;

/** Whether nobody needs the tour: it was seen in this browser, or a pop was made in this run, as on the stage. */
export const tourDone = ({ events }: Source): boolean =>
  remembered("tour") !== null || events.value.some(({ what }) => what === "pop");

/** What a person has done of the tour, from the ticks and events of a run. */
export class Progress {
  /** Number of tasks done; the task with this index is next. */
  done = 0;
  /** The last pop that was made; null before it. */
  pop: MembraneEvent | null = null;
  /** The force that fell at this pop: "force fell by 0.32 N". */
  fall = "";
  /** Whether the tip has been outside the tissue since the tour began: a needle in tissue must come out first. */
  ready = false;
  /** Whether the tip is in tissue now. */
  inside = false;
  private next = 0; // tick
  private generation = -1;
  private began = 0; // tick

  /** Takes all ticks and events since the last call. Returns whether something has changed. */
  follow({ history, events, laws }: Source): boolean {
    const before = this.state;
    if (history.generation !== this.generation) {
      // A new run; or the first call, which looks only at what happens from now on.
      this.next = this.began = this.generation === -1 ? Math.max(history.first, history.end - 1) : history.first;
      this.generation = history.generation;
      if (this.done < TASKS.length) {
        this.done = 0; // the needle is not where it was
        this.pop = null;
        this.fall = "";
        this.ready = this.inside = false;
      }
    }
    const peaks = laws.value.map(({ lower }) => Math.max(1e-9, ...lower.map(Math.abs)));
    const phases = history.byteColumn("phase");
    const forces = history.column("axial_force");
    const m = history.membranes;
    for (let tick = Math.max(this.next, history.first); tick < history.end; tick++) {
      let inside = false;
      let share = 0;
      for (let i = 0, at = history.slot(tick) * m; i < m; i++, at++) {
        inside ||= phases[at] !== OUTSIDE;
        share = Math.max(share, Math.abs(forces[at]!) / (peaks[i] ?? Number.POSITIVE_INFINITY) || 0);
      }
      this.take(inside, share);
    }
    this.next = history.end;
    const last = events.value.findLast(({ what, tick }) => what === "pop" && tick >= this.began);
    if (last && last !== this.pop) {
      this.pop = last;
      this.fall = fallOf(history, last);
    }
    if (this.pop && this.ready && this.done < 3) this.done = 3;
    return this.state !== before;
  }

  private get state(): string {
    return `${this.done} ${this.ready} ${this.inside} ${this.fall}`;
  }

  private take(inside: boolean, share: number): void {
    this.inside = inside;
    this.ready ||= !inside;
    if (!this.ready) return;
    if (this.done === 0 && inside) this.done = 1;
    if (this.done === 1 && share >= FELT) this.done = 2;
    if (this.done === 3 && !inside) this.done = 4;
  }
}
