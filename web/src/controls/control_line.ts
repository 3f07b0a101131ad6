import { button, element } from "../panel.ts";
import type { App } from "../state/app.ts";
import { controlWords } from "../state/control.ts";

/** Tells which page has control, with a button that takes it. */
export function controlLine(app: App): HTMLElement {
  const words = element("span", { role: "status", class: "control-words" });
  const take = takeControl(app);
  const show = (): void => {
    words.textContent = app.connection.value.state === "open" ? controlWords(app) : "";
  };
  app.control.watch(show);
  app.hello.watch(show);
  app.connection.watch(show);
  // Without a studio, no other page can have control.
  return element("span", { class: "control", hidden: !app.engine.studio }, words, take);
}

/** The button Take control; hidden while this page has control. */
export function takeControl(app: App): HTMLButtonElement {
  const take = button("Take control", "", () => void app.ask({ do: "take_control" }), "button");
  const show = (): void => {
    take.hidden = app.control.value.you || app.connection.value.state !== "open";
  };
  app.control.watch(show);
  app.connection.watch(show);
  return take;
}
