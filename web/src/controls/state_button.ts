import { element, everyFrame } from "../panel.ts";
import type { App } from "../state/app.ts";
import { cutFigures, LIMIT_WORDS, lastCut, limitOf } from "../state/limits.ts";
import { CUT, STATES } from "./words.ts";

const ACTIVE = 2;
const FAULTED = 3;
const HELD = 800; // ticks: a cut stays in words for so long, or nobody could read it
const EVERY = 100; // ms: numbers that change faster cannot be read

/** What each tick says of the force, which limit cuts it, and the button that arms or pauses. */
export function stateButton(app: App): HTMLElement {
  const mark = element("span", { "aria-hidden": "true" });
  const words = element("span", {});
  const figures = element("span", { class: "figures", "aria-hidden": "true" }); // they change too fast to be spoken
  const state = element("span", { class: "servo-state", role: "status" }, mark, words, figures);
  const button = element("button", { type: "button", class: "button arm" }, "Arm");
  let shown = -1;
  button.addEventListener("click", () => void app.ask({ do: shown === 0 ? "arm" : "pause" }));
  const enable = (): void => {
    button.disabled = app.connection.value.state !== "open" || !app.control.value.you || shown === FAULTED || shown < 0;
    button.title = app.control.value.you ? "" : "Another page has control";
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
    const known = history.length > 0 && app.connection.value.state === "open";
    const now = known ? (history.byteRow("state", history.end - 1)[0] ?? 0) : -1;
    if (now === shown && time - last < EVERY) return;
    last = time;
    const cut = now === ACTIVE ? lastCut(history, history.end - HELD) : null;
    const entry = STATES[now];
    if (cut !== null) write(CUT.name, CUT.mark, `Force cut: ${LIMIT_WORDS[limitOf(history, cut)]}`, CUT.why);
    else write(entry?.name ?? "none", entry?.mark ?? "", entry?.words ?? "No ticks", entry?.why ?? "");
    figures.textContent = cut === null ? "" : cutFigures(history, cut);
    if (now === shown) return;
    shown = now;
    button.textContent = now === 0 || now === FAULTED ? "Arm" : "Pause";
    enable();
  });
  return element("span", { class: "arming" }, state, button);
}
