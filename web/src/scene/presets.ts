import { element } from "../panel.ts";
import type { Preset } from "./camera.ts";

const PRESETS: readonly (readonly [Preset, string, string])[] = [
  ["oblique", "Free", "From the side and a little above"],
  ["side", "Side", "From the side"],
  ["top", "Top", "From above"],
  ["needle", "Needle", "Along the needle"],
];

/** Buttons over the view: where to look from, nearer, farther. */
export function presets(host: HTMLElement, look: (preset: Preset) => void, zoom: (factor: number) => void): void {
  const bar = element("div", { class: "view-tools", role: "toolbar", "aria-label": "View" });
  for (const [preset, label, title] of PRESETS) {
    bar.append(element("button", { type: "button", title, onclick: () => look(preset) }, label));
  }
  bar.append(
    element("button", { type: "button", title: "Nearer", "aria-label": "Nearer", onclick: () => zoom(1.3) }, "+"),
    element("button", { type: "button", title: "Farther", "aria-label": "Farther", onclick: () => zoom(1 / 1.3) }, "−"),
  );
  host.append(bar);
}
