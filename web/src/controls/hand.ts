import type { Panel } from "../panel.ts";
import { angleRow } from "./hand_angle.ts";
import { whyBarred } from "./hand_barred.ts";
import { handOf } from "./hand_model.ts";
import { keyHelp, placeRows } from "./hand_place.ts";
import { scriptRows } from "./hand_scripts.ts";
import { senseRows } from "./hand_senses.ts";

/** The simulated hand: where it is led, its angle, scripts, gamepad and sound. */
export const handPanel: Panel = (host, app) => {
  const hand = handOf(app);
  const fields = document.createElement("fieldset");
  fields.append(placeRows(app, hand), angleRow(hand), scriptRows(app, hand));
  host.append(whyBarred(app, hand), fields, senseRows(app, hand), keyHelp());
  hand.barred.watch((why) => {
    fields.disabled = why !== null;
  });
};
