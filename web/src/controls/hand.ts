import { degrees } from "../format.ts";
import { type Hand, handOf, LARGEST_TILT_DEG } from "../hand/hand.ts";
import { element, everyFrame, type Panel } from "../panel.ts";
import type { App } from "../state/app.ts";
import { takeControl } from "./control_line.ts";
import { keyHelp, placeRows } from "./hand/place.ts";
import { plungerRows } from "./hand/plunger.ts";
import { scriptRows } from "./hand/scripts.ts";
import { senseRows } from "./hand/senses.ts";

/** The Hand tab: position, angle, strokes, gamepad and sound. */
export const handPanel: Panel = (host, app) => {
  const hand = handOf(app);
  const fields = document.createElement("fieldset");
  fields.append(placeRows(app, hand), angleRow(hand), scriptRows(app, hand));
  host.append(whyBarred(app, hand), fields, plungerRows(app), senseRows(app, hand), keyHelp());
  hand.barred.watch((why) => {
    fields.disabled = why !== null;
  });
};

/** Tells why this page cannot move the hand, or how to move it. */
function whyBarred(app: App, hand: Hand): HTMLElement {
  const words = element("p", {});
  const box = element("div", { class: "hand-why" }, words, takeControl(app));
  hand.barred.watch((why) => {
    words.textContent =
      why ?? "Drag the needle in the view. It lags while tissue holds it, and jumps when the tissue gives way.";
    box.classList.toggle("barred", why !== null);
  });
  return box;
}

/** A slider for the angle between the needle and the first membrane's normal. */
function angleRow(hand: Hand): HTMLElement {
  const slider = element("input", {
    type: "range",
    id: "hand-angle",
    min: -LARGEST_TILT_DEG,
    max: LARGEST_TILT_DEG,
    step: 1,
    value: 0,
  });
  const figure = element("output", { class: "figure", for: "hand-angle" }, "–");
  let shown: number | null = null;
  const show = (): void => {
    if (!hand.pose()) return; // no tick has arrived yet
    const tilt = Math.round((hand.tilt() * 180) / Math.PI);
    if (tilt === shown && slider.value === String(tilt)) return;
    shown = tilt;
    slider.value = String(tilt);
    figure.textContent = degrees(tilt);
    slider.setAttribute("aria-valuetext", `${degrees(tilt)} from upright, ${90 - Math.abs(tilt)} to the skin`);
    figure.title = `${degrees(90 - Math.abs(tilt))} to the skin`;
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
