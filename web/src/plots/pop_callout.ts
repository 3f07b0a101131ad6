import { element } from "../panel.ts";
import { lastPop, SHOW_AGAIN, showAgain } from "../pop/again.ts";
import type { App } from "../state/app.ts";
import type { Source } from "../state/source.ts";
import type { MembraneEvent } from "../wire/messages.ts";
import type { Pane } from "./kit/axes.ts";
import { popLabel } from "./marks.ts";
import { plotsOf } from "./shared.ts";
import type { Window } from "./window.ts";

const BESIDE = 6; // px

/** A callout at the last pop in the plot: its drop, and a button that shows it again, slowly. */
export function popCallout(host: HTMLElement, app: App): (pane: Pane) => void {
  const plots = plotsOf(app);
  const words = element("span", {});
  let pop: MembraneEvent | null = null;
  const again = element(
    "button",
    {
      type: "button",
      title: `${SHOW_AGAIN} (R in the view)`,
      "aria-label": SHOW_AGAIN,
      onclick: () => {
        if (pop) showAgain(app, pop);
      },
    },
    element("span", { class: "whole" }, SHOW_AGAIN),
    element("span", { class: "short" }, "Again"),
  );
  const box = element("div", { class: "pop-callout", hidden: true }, words, again);
  host.append(box);
  let shown = "";
  let [wide, high] = [0, 0]; // px
  return (pane) => {
    pop = poppedIn(plots.source, plots.window);
    if (!pop) {
      box.hidden = true;
      shown = "";
      return;
    }
    const text = popLabel(pop, plots.source.history);
    box.hidden = false;
    if (`${text} ${pane.width}` !== shown) {
      shown = `${text} ${pane.width}`;
      words.textContent = text;
      wide = box.offsetWidth;
      high = box.offsetHeight;
    }
    const x = pane.x.px(plots.source.history.timeOf(pop.tick));
    const right = x + BESIDE + wide <= pane.left + pane.width;
    const left = right ? x + BESIDE : Math.max(pane.left, x - BESIDE - wide);
    const top = pane.top + pane.height - high - 3; // the curve of a push is above
    box.style.transform = `translate(${left.toFixed(0)}px, ${top.toFixed(0)}px)`;
  };
}

/** The last pop that the window shows; none in an excerpt, which is the pop already. */
function poppedIn(source: Source, window: Window): MembraneEvent | null {
  const pop = source.excerpt ? null : lastPop(source);
  return pop && pop.tick >= window.first && pop.tick < window.end ? pop : null;
}
