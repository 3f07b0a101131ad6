import type { Hand } from "../hand/hand.ts";
import { element } from "../panel.ts";

/** A button for fingers, which have no Shift: while it is pressed, a drag moves sideways. */
export function sidewaysButton(bar: HTMLElement, hand: Hand): () => boolean {
  let free = false;
  const title = "A drag moves the needle sideways and not in, as with Shift";
  const button = element("button", { type: "button", class: "sideways", title, "aria-pressed": "false" }, "Sideways");
  button.addEventListener("click", () => {
    free = !free;
    button.setAttribute("aria-pressed", String(free));
  });
  hand.barred.watch((why) => {
    button.disabled = why !== null;
  });
  bar.append(button);
  return () => free;
}
