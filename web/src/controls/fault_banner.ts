import { button, element, everyFrame, keepChildren, type Panel } from "../panel.ts";
import type { App } from "../state/app.ts";
import type { FaultMessage } from "../wire/messages.ts";
import { watchBlock } from "./blocked.ts";
import { nextStep, type Step } from "./fault_steps.ts";
import { countText } from "./recordings/words.ts";

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
