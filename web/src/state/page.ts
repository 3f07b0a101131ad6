import { onePerApp } from "./app.ts";
import { remember, remembered } from "./remembered.ts";
import { Signal } from "./signal.ts";

/** stage: the tissue, one sentence, one force and one curve. bench: every panel. */
type Page = "stage" | "bench";

const KEY = "page";
const pageNamed = (name: unknown): Page => (name === "bench" ? "bench" : "stage");
const visited = new WeakSet<Signal<Page>>(); // that have shown the stage

/**
 * Which of the two is shown; the browser remembers it, and its Back returns to the one before. The style sheets read it
 * as `data-page` of the root element.
 */
export const pageOf = onePerApp((app) => {
  const page = new Signal(pageNamed(remembered(KEY)));
  history.replaceState({ [KEY]: page.value }, "");
  page.watch((now) => {
    document.documentElement.dataset.page = now;
    if (now === "stage") visited.add(page);
  });
  window.addEventListener("popstate", ({ state }) => {
    if (app.sitting.value) return; // it has no bench
    page.value = pageNamed(state?.[KEY]);
    remember(KEY, page.value);
  });
  return page;
});

/** Shows the stage, if it was shown before in this visit: somebody came from it to the bench to choose something. */
export function backToStage(page: Signal<Page>): void {
  if (visited.has(page)) show(page, "stage");
}

export function show(page: Signal<Page>, wanted: Page): void {
  if (page.value !== wanted) history.pushState({ [KEY]: wanted }, "");
  page.value = wanted;
  remember(KEY, wanted);
}
