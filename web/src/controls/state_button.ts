import { element, everyFrame } from "../panel.ts";
import type { App } from "../state/app.ts";
import { controlWords } from "../state/control.ts";
import { cutFigures, cutJustNow, LIMIT_WORDS, limitOf } from "../state/limits.ts";
import { codeOf } from "../wire/ticks.ts";
import { TURN_ON, waitingFor } from "./fault_banner.ts";
import { CUT, STATES } from "./words.ts";

const FAULTED = codeOf("state", "faulted");
const DISARMED = codeOf("state", "disarmed");
const ACTIVE = codeOf("state", "active");
const WAITING = codeOf("state", "waiting");
const TURN_OFF = "Turn force off";
const INTERVAL = 100; // ms between updates; faster ones cannot be read

/** The state of the force, the limit that cuts it, and the button that turns it on or off; a fault has its own. */
export function stateButton(app: App): HTMLElement {
  const mark = element("span", { "aria-hidden": "true" });
  const words = element("span", {});
  // Hidden from screen readers, because the numbers change too fast.
  const figures = element("span", { class: "figures", "aria-hidden": "true" });
  const state = element("span", { class: "servo-state", role: "status" }, mark, words, figures);
  const button = element("button", { type: "button", class: "button arm" }, TURN_ON);
  let shown = -1;
  button.addEventListener("click", () => void app.ask({ do: shown === DISARMED ? "arm" : "pause" }));
  const enable = (): void => {
    const locked = shown === DISARMED && !app.control.value.you; // any page may turn the force off
    button.disabled = app.connection.value.state !== "open" || shown < 0 || locked;
    button.hidden = shown === FAULTED;
    button.title = locked ? controlWords(app) : "";
  };
  app.connection.watch(enable);
  app.control.watch(enable);

  let written = "";
  const write = (name: string, sign: string, text: string, why: string): void => {
    if (name + text === written) return;
    written = name + text;
    state.dataset.state = name;
    state.title = why;
    mark.textContent = sign;
    words.textContent = text;
  };
  let last = 0;
  everyFrame((time) => {
    const { history } = app.live;
    const now = servoState(app);
    if (now === shown && time - last < INTERVAL) return;
    last = time;
    const cut = now === ACTIVE ? cutJustNow(history) : null;
    const entry = STATES[now];
    if (cut !== null) write(CUT.name, CUT.mark, `Force cut: ${LIMIT_WORDS[limitOf(history, cut)]}`, CUT.why);
    else if (now === WAITING) write(entry!.name, entry!.mark, waitingFor(app), entry!.why);
    else write(entry?.name ?? "none", entry?.mark ?? "", entry?.words ?? "No ticks", entry?.why ?? "");
    figures.textContent = cut === null ? "" : cutFigures(history, cut);
    if (now === shown) return;
    shown = now;
    button.textContent = now === DISARMED ? TURN_ON : TURN_OFF;
    enable();
  });
  return element("span", { class: "arming" }, state, button);
}

/** The number of the servo's present state (see STATES); -1 without a connection or a tick. */
export function servoState(app: App): number {
  const { history } = app.live;
  if (!history.length || app.connection.value.state !== "open") return -1;
  // A device that has stopped sends no tick with the state "faulted".
  return app.fault.value ? FAULTED : (history.byteRow("state", history.end - 1)[0] ?? 0);
}
