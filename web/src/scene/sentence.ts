import { element } from "../panel.ts";
import type { App } from "../state/app.ts";

/** The one sentence that a newcomer needs, in the view of the live run until the first pop. */
export function sentence(host: HTMLElement, app: App): void {
  const words = element("p", { class: "view-sentence", hidden: true }, "Push until it gives");
  host.append(words);
  let popped = false;
  const show = (): void => {
    const { source, live, exercise } = app;
    popped ||= live.events.value.some(({ what }) => what === "pop");
    words.hidden = popped || source.value !== live || live.scene.value === null || exercise.value?.running === true;
  };
  app.live.events.watch(show);
  app.live.scene.watch(show);
  app.source.watch(show);
  app.exercise.watch(show);
}
