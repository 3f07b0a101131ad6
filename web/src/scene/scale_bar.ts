import { element } from "../panel.ts";

const LONGEST_PX = 150;

/** The longest of 1, 2, 5, 10, ... mm that is not longer than the bar may be. */
export function roundLength(mmPerPixel: number): number {
  const most = mmPerPixel * LONGEST_PX;
  const power = 10 ** Math.floor(Math.log10(most));
  const lead = most / power;
  return power * (lead >= 5 ? 5 : lead >= 2 ? 2 : 1);
}

/** A bar of a round number of millimetres, true at the tip. */
export function scaleBar(host: HTMLElement): (mmPerPixel: number) => void {
  const label = element("span", { class: "scale-label" });
  const bar = element(
    "div",
    { class: "scale-bar", role: "img", title: "Length in the plane of the needle's tip" },
    label,
  );
  host.append(bar);
  let last = "";
  return (mmPerPixel) => {
    const length = roundLength(mmPerPixel);
    const width = `${(length / mmPerPixel).toFixed(1)}px`;
    if (width === last) return;
    last = width;
    bar.style.width = width;
    label.textContent = `${length >= 1 ? length : length.toFixed(1 + Math.max(0, -Math.floor(Math.log10(length)) - 1))} mm`;
    bar.setAttribute("aria-label", `Scale: ${label.textContent}`);
  };
}
