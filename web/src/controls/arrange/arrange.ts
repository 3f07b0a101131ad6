import type { Panel } from "../../panel.ts";
import { element } from "../../panel.ts";
import { leaveExcerpt } from "../../pop/again.ts";
import { type App, onePerApp } from "../../state/app.ts";
import { pageOf } from "../../state/page.ts";
import { Arrangements, PANELS, type PanelName, PLACES, TITLES } from "./arrangement.ts";
import { menu } from "./menu.ts";
import { separator } from "./separator.ts";

/** The layout of this page; there is one per app. */
export const arrangementsOf = onePerApp(() => new Arrangements());

/**
 * Makes the panels of `root` resizable, and lets them swap places, fill the page, or stand as on a projector. The
 * style sheet (styles/layout.css) draws what the attributes and variables say that this sets.
 */
export const arrange: Panel = (root, app) => {
  const all = arrangementsOf(app);
  const page = pageOf(app);
  const panels = PANELS.map((name) => root.querySelector<HTMLElement>(`:scope > .${name}`)!);
  panels.forEach((panel, i) => {
    addPanelTools(panel, PANELS[i]!, all);
  });
  const side = root.querySelector<HTMLElement>(":scope > .side")!;
  const share = (at: number, length: number): number => at / Math.max(1, length);
  // The first panel begins where the rows of panels do.
  const top = (): number => Math.min(...panels.map((panel) => panel.getBoundingClientRect().top));
  const bottom = (): number => side.getBoundingClientRect().bottom;
  root.append(
    separator(all, "left", "Width of the left panels", (box, x) => share(x - box.left, side.offsetLeft), 1),
    separator(all, "top", "Height of the upper panels", (_, __, y) => share(y - top(), bottom() - top()), 1),
    separator(all, "side", "Width of the controls", (box, x) => box.right - x, -1),
  );
  all.now.watch((now) => {
    for (const name of ["left", "top"] as const) {
      root.style.setProperty(`--${name}`, `${now[name]}fr`);
      root.style.setProperty(`--${name}-rest`, `${1 - now[name]}fr`);
    }
    root.style.setProperty("--side", `${now.side}px`);
    now.order.forEach((name, i) => {
      const panel = panels[PANELS.indexOf(name)]!;
      panel.dataset.place = PLACES[i];
    });
    inOrder(
      root,
      now.order.map((name) => panels[PANELS.indexOf(name)]!),
    );
  });
  const attributes = (): void => {
    const onBench = page.value === "bench";
    root.toggleAttribute("data-projector", onBench && all.now.value.projector);
    root.toggleAttribute("data-maximised", onBench && all.maximised.value !== null);
    root.toggleAttribute("data-exercise", onBench && (app.exercise.value?.running ?? false));
  };
  all.now.watch(attributes);
  all.maximised.watch(attributes);
  page.watch(attributes);
  app.exercise.watch(attributes);
  all.maximised.watch((name) => {
    panels.forEach((panel, i) => {
      panel.classList.toggle("maximised", PANELS[i] === name);
    });
  });
  keys(app);
};

/**
 * The order of reading and of the tab key is the order on the page. The panel with the focus stays where it is, and the
 * others go around it: the view would lose the keys that are down.
 */
function inOrder(root: HTMLElement, panels: readonly HTMLElement[]): void {
  const now = [...root.children].filter((child) => panels.includes(child as HTMLElement));
  if (panels.every((panel, i) => panel === now[i])) return;
  const still = Math.max(
    0,
    panels.findIndex((panel) => panel.contains(document.activeElement)),
  );
  panels[still]!.before(...panels.slice(0, still));
  panels[still]!.after(...panels.slice(still + 1));
}

/** Alt+P: the layout for a projector. Escape: back to all panels, then back from a pop that is shown again. */
function keys(app: App): void {
  const all = arrangementsOf(app);
  document.addEventListener("keydown", (event) => {
    if (event.altKey && !event.ctrlKey && event.code === "KeyP") {
      if (pageOf(app).value === "stage") return; // which is for a projector already
      event.preventDefault();
      all.set({ projector: !all.now.value.projector });
    } else if (event.key === "Escape" && !event.defaultPrevented && !document.querySelector("dialog[open]")) {
      if (all.maximised.value !== null) all.maximised.value = null;
      else leaveExcerpt(app);
    }
  });
}

const BARS = ".view-tools, .plot-bar, .phases-head";
const CONTROLS = "button, select, input, summary, canvas";

/** The buttons Swap and Maximise of a panel, at the end of its bar. A double click on the bar maximises, too. */
function addPanelTools(host: HTMLElement, name: PanelName, all: Arrangements): void {
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
