import { handOf } from "../hand/hand.ts";
import type { Panel } from "../panel.ts";
import { angleRow } from "./hand/angle.ts";
import { whyBarred } from "./hand/barred.ts";
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
