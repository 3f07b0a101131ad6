import { button, element, everyFrame } from "../panel.ts";
import type { App } from "../state/app.ts";
import { feltForce, scaleOf, scaleText } from "../state/scale.ts";
import { type Saving, save } from "./save.ts";
import type { Plots } from "./shared.ts";

/** A drop-down list whose entries can change. */
export function choice(
  label: string,
  entries: ReadonlyArray<readonly [value: string, text: string]>,
  value: string,
  chosen: (value: string) => void,
): { select: HTMLSelectElement; offer(entries: ReadonlyArray<readonly [string, string]>, value: string): void } {
  const select = element("select", { "aria-label": label, title: label, onchange: () => chosen(select.value) });
  const offer = (offered: ReadonlyArray<readonly [string, string]>, now: string): void => {
    select.replaceChildren(...offered.map(([key, text]) => element("option", { value: key }, text)));
    select.value = now;
  };
  offer(entries, value);
  return { select, offer };
}

/** A button that pauses the page at the present moment, or goes back to the live run. The run itself goes on. */
export function pauseButton(app: App): HTMLButtonElement {
  const title = "Pause the page at this moment; the run goes on (Space)";
  const made = button("Pause", title, () => (app.source.value.paused ? app.goLive() : app.pause()), "plot-pause");
  app.source.watch((source) => {
    made.disabled = !source.live && !source.paused; // a recording does not move by itself
    made.setAttribute("aria-pressed", String(source.paused));
  });
  return made;
}

/** A menu that saves the plot's window. */
export function saveMenu(saving: Saving): HTMLElement {
  const entry = (format: "png" | "svg" | "csv", text: string): HTMLButtonElement =>
    button(text, `Save as ${text}`, () => {
      made.open = false;
      void save(saving, format);
    });
  const entries = [entry("png", "PNG picture"), entry("svg", "SVG drawing"), entry("csv", "CSV, every tick")];
  const made = menu("Save", "Save the plot", element("div", {}, ...entries));
  made.classList.add("plot-save");
  return made;
}

/** A menu that opens below its word, and closes when something else is used. */
export function menu(word: string, title: string, content: HTMLElement): HTMLDetailsElement {
  const menu = element("details", { class: "plot-menu" }, element("summary", { title }, word), content);
  menu.addEventListener("keydown", (event) => {
    if (event.key !== "Escape" || !menu.open) return;
    menu.open = false;
    menu.querySelector("summary")?.focus();
    event.preventDefault();
    event.stopPropagation();
  });
  const leave = (to: EventTarget | null): void => {
    if (to instanceof Node && !menu.contains(to)) menu.open = false;
  };
  menu.addEventListener("focusout", (event) => leave(event.relatedTarget));
  document.addEventListener("pointerdown", (event) => leave(event.target));
  return menu;
}

/** Tells how much of the model's force the device gives; hidden if that is all of it. */
export function scaleChip(plots: Plots): HTMLElement {
  const chip = element("span", { class: "force-scale", hidden: true });
  let shown = 1;
  everyFrame(() => {
    const scale = scaleOf(plots.source);
    if (scale === shown) return;
    shown = scale;
    chip.hidden = scale === 1;
    chip.textContent = feltForce(scale);
    chip.title = `This device gives ${scaleText(scale)} of the model force`;
  });
  return chip;
}
