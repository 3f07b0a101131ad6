import { element } from "../panel.ts";
import { colourToken } from "../state/colours.ts";

/** A membrane's number, in its colour of the plots. */
export const badge = (membrane: number): HTMLElement =>
  element("span", { class: `badge ${colourToken(membrane)}`, "aria-hidden": "true" }, String(membrane + 1));
