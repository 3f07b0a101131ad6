import { element, everyFrame } from "../panel.ts";
import type { App } from "../state/app.ts";
import { STATES } from "./words.ts";

const FAULTED = 3;

/** What each tick says of the force, and the button that arms or pauses. */
export function stateButton(app: App): HTMLElement {
  const mark = element("span", { "aria-hidden": "true" });
  const words = element("span", {});
  const state = element("span", { class: "servo-state", role: "status" }, mark, words);
  const button = element("button", { type: "button", class: "button arm" }, "Arm");
  let shown = -1;
  button.addEventListener("click", () => void app.ask({ do: shown === 0 ? "arm" : "pause" }));
  const enable = (): void => {
    button.disabled = app.connection.value.state !== "open" || !app.control.value.you || shown === FAULTED || shown < 0;
    button.title = app.control.value.you ? "" : "Another page has control";
  };
  app.connection.watch(enable);
  app.control.watch(enable);
  everyFrame(() => {
    const { history } = app.live;
    const known = history.length > 0 && app.connection.value.state === "open";
    const now = known ? (history.byteRow("state", history.end - 1)[0] ?? 0) : -1;
    if (now === shown) return;
    shown = now;
    const entry = STATES[now];
    state.dataset.state = entry?.name ?? "none";
    state.title = entry?.why ?? "";
    mark.textContent = entry?.mark ?? "";
    words.textContent = entry?.words ?? "No ticks";
    button.textContent = now === 0 || now === FAULTED ? "Arm" : "Pause";
    enable();
  });
  return element("span", { class: "arming" }, state, button);
}
