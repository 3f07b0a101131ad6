import { element } from "../panel.ts";

const LONGEST_PX = 150;

/** The largest of 1, 2, 5, 10, ... mm that fits into the longest allowed bar. */
export function roundLength(mmPerPixel: number): number {
  const most = mmPerPixel * LONGEST_PX;
  const power = 10 ** Math.floor(Math.log10(most));
  const lead = most / power;
  return power * (lead >= 5 ? 5 : lead >= 2 ? 2 : 1);
}

/** A bar of a round number of millimetres, exact at the depth of the tip. */
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
    const places = length >= 1 ? 0 : -Math.floor(Math.log10(length));
    label.textContent = `${length.toFixed(places)} mm`;
    bar.setAttribute("aria-label", `Scale: ${label.textContent}`);
  };
}
