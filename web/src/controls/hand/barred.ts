import type { Hand } from "../../hand/hand.ts";
import { element } from "../../panel.ts";
import type { App } from "../../state/app.ts";
import { takeControl } from "../control_line.ts";

/** Tells why this page cannot move the hand, or how to move it. */
export function whyBarred(app: App, hand: Hand): HTMLElement {
  const words = element("p", {});
  const box = element("div", { class: "hand-why" }, words, takeControl(app));
  hand.barred.watch((why) => {
    words.textContent =
      why ?? "Drag the needle in the view. It lags while tissue holds it, and jumps when the tissue gives way.";
    box.classList.toggle("barred", why !== null);
  });
  return box;
}
