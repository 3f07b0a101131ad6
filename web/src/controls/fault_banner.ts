import { element, everyFrame, keepChildren, type Panel } from "../panel.ts";
import { nextStep, type Step } from "./fault_steps.ts";
import { faultTicksLink } from "./fault_ticks.ts";

/** After a fault: one sentence that says what happened and what to do, the one button for it, and the ticks. */
export const faultBanner: Panel = (host, app) => {
  host.setAttribute("role", "alert");
  let step: Step | null = null;
  const happened = element("strong");
  const todo = element("span");
  const button = element("button", { type: "button", class: "button danger", onclick: () => step?.act?.() });
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
    if (button.textContent !== step.label) button.textContent = step.label;
    button.disabled = step.act === null || app.connection.value.state !== "open";
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
    keepChildren(host, [mark, words, button]);
  });
  everyFrame(look);
};
