import { element } from "../panel.ts";
import type { Preset } from "./camera.ts";

const PRESETS: readonly (readonly [Preset, string, string])[] = [
  ["oblique", "Free", "From the side and a little above"],
  ["side", "Side", "From the side"],
  ["top", "Top", "From above"],
  ["needle", "Needle", "Along the needle"],
];

/** Buttons over the view: the presets, and zoom. Returns their bar. */
export function presets(
  host: HTMLElement,
  look: (preset: Preset) => void,
  zoom: (factor: number) => void,
): HTMLElement {
  const bar = element("div", { class: "view-tools", role: "toolbar", "aria-label": "View" });
  for (const [preset, label, title] of PRESETS) {
    bar.append(element("button", { type: "button", title, onclick: () => look(preset) }, label));
  }
  const zoomButton = (text: string, title: string, factor: number): HTMLElement =>
    element("button", { type: "button", title, "aria-label": title, onclick: () => zoom(factor) }, text);
  bar.append(zoomButton("+", "Zoom in", 1.3), zoomButton("−", "Zoom out", 1 / 1.3));
  host.append(bar);
  return bar;
}
