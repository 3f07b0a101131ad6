import { type Hand, LARGEST_TILT_DEG } from "../../hand/hand.ts";
import { element, everyFrame } from "../../panel.ts";

/** A slider for the angle between the needle and the first membrane's normal. */
export function angleRow(hand: Hand): HTMLElement {
  const slider = element("input", {
    type: "range",
    id: "hand-angle",
    min: -LARGEST_TILT_DEG,
    max: LARGEST_TILT_DEG,
    step: 1,
    value: 0,
  });
  const figure = element("output", { class: "figure", for: "hand-angle" }, "–°");
  let shown: number | null = null;
  const show = (): void => {
    if (!hand.pose()) return; // no tick has arrived yet
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
  // An exercise, strokes or another page can tilt the needle too.
  everyFrame(show);
  return element(
    "section",
    { class: "rows" },
    element("h3", {}, element("label", { for: "hand-angle" }, "Angle, from upright")),
    element("div", { class: "row" }, slider, figure),
  );
}
