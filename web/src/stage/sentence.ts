import { Progress, TASKS } from "../controls/tour/progress.ts";
import { instruction } from "../controls/tour/words.ts";
import { mm, unbroken } from "../format.ts";
import { handOf } from "../hand/hand.ts";
import type { App } from "../state/app.ts";
import { remember, remembered } from "../state/remembered.ts";
import { type Band, bandAt } from "../tissue/bands.ts";
import type { Felt } from "./attempt.ts";

/** What the stage says. takeOver: that another page, or none, moves the needle, so that this page may take control. */
interface Words {
  readonly text: string;
  readonly takeOver: boolean;
}

/** The one sentence of the stage: what is, or what to do next, as the needle is now. */
export class Sentence {
  private readonly progress = new Progress();
  private readonly learnt = remembered("tour") !== null; // in an earlier visit
  private ended: number | null = null; // the history's generation in which all was done
  private moved = -1; // the last run in which this page moved the needle

  constructor(private readonly app: App) {}

  /** now: of the needle; null if it is not known, or must not be told. */
  words(bands: readonly Band[], now: Felt | null): Words {
    const words = this.choose(bands, now);
    return typeof words === "string" ? { text: unbroken(words), takeOver: false } : words;
  }

  private choose(bands: readonly Band[], now: Felt | null): string | Words {
    const { app, progress } = this;
    if (app.sitting.value)
      return app.connection.value.state === "open" ? app.sitting.value.sentence : app.sitting.value.gone;
    const { excerpt, paused, live, title } = app.source.value;
    const simulated = app.hello.value?.device.simulated ?? true;
    const skin = app.live.scene.value?.membranes[0]?.name ?? "tissue";
    if (app.live.history.length) progress.follow(app.live);
    const all = progress.done === TASKS.length;
    if (all && remembered("tour") === null) remember("tour", "seen");
    if (all) this.ended ??= app.live.history.generation;
    const over = this.ended !== null && (progress.inside || this.ended !== app.live.history.generation);
    const exercise = app.exercise.value;
    if (app.connection.value.state !== "open" && app.engine.studio) return handOf(app).barred.value ?? "";
    if (excerpt)
      return excerpt.event
        ? `The pop of the ${excerpt.event.name}, slowly.`
        : "The worst moment of the attempt, slowly.";
    if (paused) return "Paused; the run goes on.";
    if (!live) return `Replay of ${title}`;
    const barred = simulated ? handOf(app).barred.value : null;
    const { you, holder } = app.control.value;
    if (you) this.moved = app.run.value;
    const watches = barred !== null && !you && app.connection.value.state === "open";
    if (barred && !watches) return barred;
    // A page that only looks on says what the person at the other one shall do.
    const wants = [this.moved, handOf(app).tried].includes(app.run.value);
    if (watches && (wants || (exercise?.running && holder === null))) return { text: barred, takeOver: true };
    if (exercise?.running) return exercise.instruction;
    if (watches) return place(bands, now) || { text: barred, takeOver: true };
    if (!this.learnt && !over) return instruction(progress, skin, simulated, true);
    return place(bands, now) || instruction(FRESH, skin, simulated);
  }
}

/** Where the tip is, in words; empty in front of the skin. */
function place(bands: readonly Band[], now: Felt | null): string {
  const band = now && bandAt(bands, now.depth);
  if (!band) return "";
  return `The tip is in the ${band.name || "tissue"}, ${mm(now.depth / 1e3, 0)} deep.`;
}

/** Of somebody who has the needle in front of the skin. */
const FRESH = Object.assign(new Progress(), { ready: true });
