import { element } from "../panel.ts";

const COLOURS = 5; // --data-1 to --data-5

/** A membrane's number, in its colour of the plots. */
export const badge = (membrane: number): HTMLElement =>
  element("span", { class: `badge data-${(membrane % COLOURS) + 1}`, "aria-hidden": "true" }, String(membrane + 1));
