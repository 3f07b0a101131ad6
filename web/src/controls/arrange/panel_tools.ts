import { element } from "../../panel.ts";
import { type Arrangements, type PanelName, TITLES } from "./arrangement.ts";
import { menu } from "./menu.ts";

const BARS = ".view-tools, .plot-bar, .phases-head";
const CONTROLS = "button, select, input, summary, canvas";

/** The buttons Swap and Maximise of a panel, at the end of its bar. A double click on the bar maximises, too. */
export function addPanelTools(host: HTMLElement, name: PanelName, all: Arrangements): void {
  const title = TITLES[name];
  const swap = menu(`Swap ${title} with another panel`, "⇄", () =>
    all.now.value.order
      .filter((each) => each !== name)
      .map((each) => [`Swap with ${TITLES[each]}`, () => all.swap(name, each)]),
  );
  const max = element("button", { type: "button", class: "maximise", onclick: () => all.toggle(name) });
  all.maximised.watch((now) => {
    const on = now === name;
    max.textContent = on ? "✕" : "";
    max.title = on ? "Back to all panels (Escape)" : `Maximise ${title}`;
    max.setAttribute("aria-label", max.title);
  });
  const bar = host.querySelector<HTMLElement>(BARS) ?? host;
  bar.append(element("span", { class: "panel-tools" }, swap, max));
  bar.addEventListener("dblclick", (event) => {
    if (!(event.target as Element).closest(CONTROLS)) all.toggle(name);
  });
}
