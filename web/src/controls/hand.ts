import type { Hand } from "../hand/hand.ts";
import { handOf } from "../hand/hand.ts";
import type { Panel } from "../panel.ts";
import { element } from "../panel.ts";
import type { App } from "../state/app.ts";
import { takeControl } from "./control_line.ts";
import { angleRow } from "./hand/angle.ts";
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
