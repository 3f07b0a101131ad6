import { element } from "../panel.ts";
import type { App } from "../state/app.ts";
import { connectionWords } from "./words.ts";

const SILENT_MS = 2000;
const LOOK_MS = 250;

/** A line with the state of the connection. It also tells if the studio is connected but sends no ticks. */
export function connectionLine(app: App): HTMLElement {
  const dot = element("span", { class: "dot", "aria-hidden": "true" });
  // The countdown is only visible; a screen reader gets the changes of state.
  const words = element("span", { class: "connection-words", "aria-hidden": "true" });
  const spoken = element("span", { class: "only-read", role: "status" });
  const line = element("span", { class: "connection" }, dot, words, spoken);
  let since = performance.now();
  let end = -1;
  let lastTick = performance.now();
  const show = (): void => {
    const now = app.connection.value;
    const { history } = app.live;
    if (history.end !== end) {
      end = history.end;
      lastTick = performance.now();
    }
    const silent = now.state === "open" && performance.now() - Math.max(lastTick, since) > SILENT_MS;
    const left = now.state === "lost" ? now.retryInMs - (performance.now() - since) : 0;
    const text = connectionWords(now, silent, left, app.engine.studio);
    if (words.textContent !== text) words.textContent = text;
    const state = now.state === "lost" ? "No connection; retrying" : text;
    const steady = now.state === "connecting" && now.attempt > 1 ? spoken.textContent : state;
    if (spoken.textContent !== steady) spoken.textContent = steady;
    line.dataset.state = silent ? "lost" : now.state;
    line.title = now.state === "lost" ? now.reason : "";
  };
  app.connection.watch(() => {
    since = performance.now();
    show();
  });
  setInterval(show, LOOK_MS);
  return line;
}
