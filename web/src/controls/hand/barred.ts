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
      why ?? "Drag the needle in the picture. It lags where tissue holds it, and jumps where it gives way.";
    box.classList.toggle("barred", why !== null);
  });
  return box;
}
