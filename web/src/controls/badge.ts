import { element } from "../panel.ts";
import { colourToken } from "../state/colours.ts";

/** A membrane's number in its colour. The number serves readers who cannot tell the colours apart. */
export function badge(membrane: number): HTMLElement {
  const made = element("span", { class: "badge", "aria-hidden": "true" }, String(membrane + 1));
  made.style.setProperty("--mark", `var(--${colourToken(membrane)})`);
  return made;
}
