import { handOf } from "../hand/hand.ts";
import type { App } from "../state/app.ts";
import { controlWords } from "../state/control.ts";
import { inTissue } from "../state/tissue.ts";

/** The next thing that leads out of a fault: what its button does, and the sentence that says what is missing. */
export interface Step {
  readonly label: string;
  readonly sentence: string;
  /** null: the page cannot do it; a person must. */
  readonly act: (() => void) | null;
}

export const TURN_ON = "Turn force on";

/** What to press after a fault, or what to do before that. */
export function nextStep(app: App): Step {
  if (!app.control.value.you) {
    const act = (): void => void app.ask({ do: "take_control" });
    return { label: "Take control", sentence: `${controlWords(app)}: take control first.`, act };
  }
  const moves = app.status.value?.hand;
  const outByItself = moves === "strokes" || moves === "motion";
  if (!inTissue(app) || outByItself) {
    return { label: TURN_ON, sentence: `Then press “${TURN_ON}”.`, act: () => void turnOn(app) };
  }
  const sentence = `Then draw the needle out of the tissue and press “${TURN_ON}”.`;
  if (!app.hello.value?.device.simulated) return { label: TURN_ON, sentence, act: null };
  const out = (): void => {
    app.source.value = app.live;
    handOf(app).home();
  };
  return { label: "Draw the needle out", sentence, act: out };
}

/** Ends the fault, then allows force. The loop gives it only when the tip is outside tissue. */
async function turnOn(app: App): Promise<void> {
  if ((await app.ask({ do: "reset" }))?.ok) await app.ask({ do: "arm" });
}

/** Why an armed loop gives no force yet, in a few words. */
export function waitingFor(app: App): string {
  if (inTissue(app)) return "Waiting: draw the needle out of the tissue";
  const buttons = app.hello.value?.limits.dead_man_buttons ?? [];
  return buttons.length ? `Waiting: hold button ${buttons.join(" or ")} of the device` : "Waiting";
}
