import { handOf } from "../hand/hand.ts";
import { button, element, everyFrame, keepChildren, type Panel } from "../panel.ts";
import type { App } from "../state/app.ts";
import { controlWords } from "../state/control.ts";
import type { FaultMessage } from "../wire/messages.ts";
import { watchBlock } from "./blocked.ts";
import { countText } from "./recordings/words.ts";

/** The next thing that leads out of a fault: what its button does, and the sentence that says what is missing. */
interface Step {
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

/** Whether the tip is behind the surface of a membrane; null if its position is not known. */
export function inTissue(app: App): boolean | null {
  const { history, scene } = app.live;
  if (history.length === 0 || !scene.value) return null;
  const tip = history.row("position", history.end - 1);
  if (![...tip].every(Number.isFinite)) return null;
  return scene.value.membranes.some(
    ({ point, inward_normal: inward }) => inward.reduce((sum, n, i) => sum + n * (tip[i]! - point[i]!), 0) > 0,
  );
}

/** After a fault: one sentence that says what happened and what to do, the one button for it, and the ticks. */
export const faultBanner: Panel = (host, app) => {
  host.setAttribute("role", "alert");
  let step: Step | null = null;
  const happened = element("strong");
  const todo = element("span");
  const next = button("", "", () => step?.act?.(), "button danger");
  const link = element("span", { class: "fault-more" });
  const mark = element("span", { class: "fault-mark", "aria-hidden": "true" }, "▲");
  const words = element("div", { class: "fault-words" }, element("p", {}, happened, " ", todo), link);

  /** Changes only what is new: screen readers read every change. */
  const look = (): void => {
    const fault = app.fault.value;
    if (!fault) return;
    step = nextStep(app);
    const text = `${fault.remedy} ${step.sentence}`;
    if (todo.textContent !== text) todo.textContent = text;
    if (next.textContent !== step.label) next.textContent = step.label;
    next.disabled = step.act === null || app.connection.value.state !== "open";
  };
  app.fault.watch((fault) => {
    if (!fault) {
      host.replaceChildren();
      return;
    }
    const trouble = fault.trouble && ` The device says: ${fault.trouble}${/[.!?]$/.test(fault.trouble) ? "" : "."}`;
    happened.textContent = `The force is off. ${fault.reason}${trouble}`;
    link.replaceChildren(faultTicksLink(app, fault));
    look();
    keepChildren(host, [mark, words, next]);
  });
  everyFrame(look);
};

/** A link that saves the ticks before a fault; empty if none are kept. */
function faultTicksLink(app: App, fault: FaultMessage): Node {
  if (fault.kept === 0) return document.createTextNode("");
  const href = app.api.address("/api/fault.csv");
  return element("a", { href, download: "" }, `Save the ${countText(fault.kept)} ticks before the fault (CSV)`);
}

/** The last fault, and a demonstration without harm: the simulated device reports one position that is not a number. */
export const faultTrial: Panel = (host, app) => {
  const last = element("p", { class: "quiet", hidden: true });
  app.fault.watch((fault) => {
    if (!fault) return;
    last.hidden = false;
    last.replaceChildren(`Last fault: ${fault.reason} `, faultTicksLink(app, fault));
  });
  const trip = button("Try a fault", "", () => void app.ask({ do: "trip_fault" }), "button");
  const words =
    "The simulated device reports a position that is not a number. The force ends at once, and stays off until you " +
    "turn it on.";
  const trial = element("div", { hidden: true }, element("p", { class: "quiet" }, words), trip);
  host.append(element("section", { class: "fault-trial" }, element("h3", {}, "Faults"), last, trial));
  app.hello.watch((hello) => {
    trial.hidden = !hello?.device.simulated;
  });
  watchBlock(app, (block) => {
    trip.disabled = block !== null;
  });
};
