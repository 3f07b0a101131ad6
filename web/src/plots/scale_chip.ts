import { element, everyFrame } from "../panel.ts";
import { feltForce, scaleOf, scaleText } from "../state/scale.ts";
import type { Plots } from "./shared.ts";

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
