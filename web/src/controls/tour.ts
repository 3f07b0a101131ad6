import { unbroken } from "../format.ts";
import { handOf } from "../hand/hand.ts";
import { element, everyFrame, type Panel } from "../panel.ts";
import { SHOW_AGAIN, showAgain } from "../pop/again.ts";
import type { App } from "../state/app.ts";
import { pageOf } from "../state/page.ts";
import { remember } from "../state/remembered.ts";
import { askSound } from "./hand/sound.ts";
import { Progress, TASKS, tourDone } from "./tour/progress.ts";
import { instruction, NAMES } from "./tour/words.ts";

let begin: () => void = () => {};

/** Starts the tour from its first step, even if it was seen before. */
export const startTour = (): void => begin();

/**
 * Four things to do with the needle. Each is done when the ticks show it. The tour is a bar above the page, so it
 * covers nothing. Escape in the bar ends it.
 */
export const tour: Panel = (root, app) => {
  let end: () => void = () => {};
  begin = () => {
    end();
    app.source.value = app.live;
    handOf(app).home();
    end = show(root, app);
  };
  askSound(root, app);
  // It starts on the bench, with the first ticks, when there is something to do, and all earlier events are here.
  const stop = everyFrame(() => {
    if (pageOf(app).value !== "bench" || app.live.history.length === 0) return;
    stop();
    if (!tourDone(app.live)) end = show(root, app);
  });
};

function show(root: HTMLElement, app: App): () => void {
  const hand = handOf(app);
  const progress = new Progress();
  const steps = NAMES.map((name) => element("li", {}, name));
  const words = element("p", { "aria-live": "polite" });
  const again = element("button", { type: "button", hidden: true }, SHOW_AGAIN);
  const close = element("button", { type: "button" }, "Skip the tour");
  const bar = element(
    "section",
    { class: "tour", "aria-label": "Tour" },
    element("ol", {}, ...steps),
    words,
    again,
    close,
  );
  const show = (): void => {
    const { done, ready } = progress;
    steps.forEach((step, i) => {
      step.className = i < done ? "done" : "";
      if (i === done && ready) step.setAttribute("aria-current", "step");
      else step.removeAttribute("aria-current");
    });
    const simulated = app.hello.value?.device.simulated ?? true;
    const skin = app.live.scene.value?.membranes[0]?.name ?? "tissue";
    const slow = app.source.value.excerpt !== null;
    const barred = simulated && !slow && done < TASKS.length ? hand.barred.value : null;
    const text = slow ? "This was the pop, slowly." : (barred ?? unbroken(instruction(progress, skin, simulated)));
    if (words.textContent !== text) words.textContent = text;
    again.hidden = done < TASKS.length || progress.pop === null;
    close.textContent = done < TASKS.length ? "Skip the tour" : "Done";
    if (done === TASKS.length) remember("tour", "seen");
  };
  again.addEventListener("click", () => {
    if (progress.pop) showAgain(app, progress.pop);
  });
  const ends = [
    hand.barred.watch(show),
    app.source.watch(show),
    app.live.scene.watch(show),
    app.exercise.watch((exercise) => {
      bar.hidden = exercise?.running ?? false; // an exercise has instructions of its own
    }),
    everyFrame(() => {
      if (!bar.hidden && app.live.history.length && progress.follow(app.live)) show();
    }),
  ];
  const finish = (): void => {
    remember("tour", "seen");
    for (const end of ends) end();
    bar.remove();
  };
  const keys = (event: KeyboardEvent): void => {
    if (event.key !== "Escape") return;
    event.preventDefault(); // the panels keep their size
    finish();
  };
  close.addEventListener("click", finish);
  bar.addEventListener("keydown", keys); // elsewhere, Escape belongs to menus, dialogs and the view
  root.before(bar);
  return finish;
}
