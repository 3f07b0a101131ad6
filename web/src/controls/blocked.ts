import { element } from "../panel.ts";
import type { App } from "../state/app.ts";
import { controlWords } from "../state/control.ts";

export interface Block {
  readonly reason: string;
  readonly remedy: "control" | "live" | null;
}

/** `scene`: changes of the scene or the recording, which a running exercise forbids; `run`: everything else. */
export type Reach = "run" | "scene";

/** The reason why this page cannot change the run now; null if it can. */
export function blockOf(app: App, reach: Reach = "run"): Block | null {
  if (app.connection.value.state !== "open") {
    const reason = app.engine.studio ? "No connection to the studio." : "The core does not run in this page yet.";
    return { reason, remedy: null };
  }
  if (!app.source.value.live) {
    const what = app.source.value.paused
      ? "The page is paused; the run goes on."
      : "A recording is shown, not the live run.";
    return { reason: what, remedy: "live" };
  }
  if (!app.control.value.you) {
    return { reason: `${controlWords(app)}.`, remedy: "control" };
  }
  if (reach === "scene" && app.exercise.value?.running) {
    return { reason: "An exercise is running: scene and recording are locked.", remedy: null };
  }
  return null;
}

/** Calls the listener now, and whenever the reason changes. */
export function watchBlock(app: App, listener: (block: Block | null) => void, reach: Reach = "run"): void {
  let last: string | null | undefined;
  const look = (): void => {
    const block = blockOf(app, reach);
    const reason = block?.reason ?? null;
    if (reason === last) return;
    last = reason;
    listener(block);
  };
  app.connection.watch(look);
  app.source.watch(look);
  app.control.watch(look);
  if (reach === "scene") app.exercise.watch(look);
}

/** A line of fixed height: the text `free`, or the reason for the block with a button that ends it. */
export function blockLine(app: App, free: string, reach: Reach = "run"): HTMLElement {
  const words = element("span");
  const button = element("button", { type: "button", class: "small" });
  const line = element("div", { class: "block-line", role: "status" }, words, button);
  let remedy: Block["remedy"] = null;
  button.addEventListener("click", () => {
    if (remedy === "live") app.goLive();
    else void app.ask({ do: "take_control" });
  });
  watchBlock(
    app,
    (block) => {
      remedy = block?.remedy ?? null;
      words.textContent = block?.reason ?? free;
      line.classList.toggle("blocked", block !== null);
      button.hidden = remedy === null;
      button.textContent = remedy === "live" ? "Back to live" : "Take control";
    },
    reach,
  );
  return line;
}
