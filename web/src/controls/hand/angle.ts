import type { Hand } from "../../hand/hand.ts";
import { element, everyFrame } from "../../panel.ts";

const MOST_DEGREES = 75;

/** The angle of the needle to the first membrane's normal. */
export function angleRow(hand: Hand): HTMLElement {
  const slider = element("input", {
    type: "range",
    id: "hand-angle",
    min: -MOST_DEGREES,
    max: MOST_DEGREES,
    step: 1,
    value: 0,
  });
  const figure = element("output", { class: "figure", for: "hand-angle" }, "–°");
  let shown: number | null = null;
  const show = (): void => {
    if (!hand.pose()) return; // nothing is known yet
    const degrees = Math.round((hand.tilt() * 180) / Math.PI);
    if (degrees === shown && slider.value === String(degrees)) return;
    shown = degrees;
    slider.value = String(degrees);
    figure.textContent = `${degrees}°`;
    slider.setAttribute("aria-valuetext", `${degrees} degrees from upright, ${90 - Math.abs(degrees)} to the skin`);
    figure.title = `${90 - Math.abs(degrees)}° to the skin`;
  };
  slider.addEventListener("input", () => {
    hand.setTilt((Number(slider.value) * Math.PI) / 180);
    show();
  });
  // Others turn the needle, too: an exercise, strokes, another page.
  everyFrame(show);
  return element(
    "section",
    { class: "rows" },
    element("h3", {}, element("label", { for: "hand-angle" }, "Angle, from upright")),
    element("div", { class: "row" }, slider, figure),
  );
}
