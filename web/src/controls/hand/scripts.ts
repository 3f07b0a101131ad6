import type { Hand } from "../../hand/hand.ts";
import { element } from "../../panel.ts";
import type { App } from "../../state/app.ts";

/** Starts and stops automatic strokes. */
export function scriptRows(app: App, hand: Hand): HTMLElement {
  const period = element("input", {
    type: "number",
    id: "stroke-period",
    min: 0.5,
    max: 60,
    step: 0.5,
    value: 4,
    class: "short",
  });
  const button = element("button", { type: "button", class: "button", "aria-pressed": "false" }, "Start strokes");
  let stroking = false;
  app.exercise.watch((status) => {
    button.disabled = status?.running ?? false; // the studio refuses strokes then
    button.title = button.disabled ? "The exercise judges your own hand" : "";
  });
  app.status.watch((status) => {
    stroking = status?.hand === "strokes";
    button.textContent = stroking ? "Stop strokes" : "Start strokes";
    button.setAttribute("aria-pressed", String(stroking));
  });
  const start = (): void => {
    hand.release();
    void app.ask({ do: "strokes", period: Math.min(60, Math.max(0.5, Number(period.value) || 4)) });
  };
  button.addEventListener("click", () => (stroking ? hand.hold() : start()));
  period.addEventListener("change", () => {
    if (stroking) start();
  });
  return element(
    "section",
    { class: "rows" },
    element("h3", {}, "Strokes through all membranes"),
    element(
      "div",
      { class: "row" },
      element("label", { for: "stroke-period" }, "Period"),
      period,
      element("span", {}, "s"),
      button,
    ),
    element("p", { class: "hint", hidden: !app.engine.studio }, "For a recorded motion, see the Recordings tab."),
  );
}
