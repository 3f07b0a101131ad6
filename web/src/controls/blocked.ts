import { element } from "../panel.ts";
import type { App } from "../state/app.ts";

export interface Block {
  readonly reason: string;
  readonly remedy: "control" | "live" | null;
}

/** `scene`: what changes the scene or the recording, which an exercise keeps; `run`: everything else. */
export type Reach = "run" | "scene";

/** Why this page cannot change the run now; null where it can. */
export function blockOf(app: App, reach: Reach = "run"): Block | null {
  if (app.connection.value.state !== "open") return { reason: "There is no connection to the studio.", remedy: null };
  if (!app.source.value.live) {
    return { reason: "You are looking at a recording, not at the run.", remedy: "live" };
  }
  if (!app.control.value.you) return { reason: "Another page has control.", remedy: "control" };
  if (reach === "scene" && app.exercise.value?.running) {
    return { reason: "An exercise is running: its scene and its recording stay as they are.", remedy: null };
  }
  return null;
}

/** Calls now and whenever it may have changed. */
export function watchBlock(app: App, listener: (block: Block | null) => void, reach: Reach = "run"): void {
  let last: string | null = "none yet";
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

/** A line that always keeps its place: `free` while all is well, else the reason and what takes it away. */
export function blockLine(app: App, free: string, reach: Reach = "run"): HTMLElement {
  const words = element("span");
  const button = element("button", { type: "button", class: "small" });
  const line = element("div", { class: "block-line", role: "status" }, words, button);
  let remedy: Block["remedy"] = null;
  button.addEventListener("click", () => {
    if (remedy === "live") app.source.value = app.live;
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
