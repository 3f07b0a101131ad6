import { element } from "../panel.ts";
import type { App } from "../state/app.ts";
import { handOf } from "./hand.ts";
import { FIRM, thumbOf } from "./thumb.ts";
import { wheelDepth } from "./wheel.ts";

/**
 * A button that pushes the syringe's plunger while it is held, with a pointer or with Space or Enter. A mouse that
 * holds it moves the needle with its wheel.
 */
export function thumbButton(app: App, label: string, style: string): HTMLButtonElement {
  const thumb = thumbOf(app);
  const push = element("button", { type: "button", class: style, "aria-pressed": "false" }, label);
  const hold = (on: boolean): void => thumb.push(style, on ? FIRM : 0);
  push.addEventListener("pointerdown", (event) => {
    push.setPointerCapture(event.pointerId);
    hold(true);
  });
  for (const end of ["pointerup", "pointercancel", "lostpointercapture", "blur"]) {
    push.addEventListener(end, () => hold(false));
  }
  push.addEventListener(
    "wheel",
    (event) => {
      if (thumb.force.value === 0) return;
      event.preventDefault();
      handOf(app).push(wheelDepth(event) / 1e3);
    },
    { passive: false },
  );
  push.addEventListener("contextmenu", (event) => event.preventDefault()); // of a finger that stays
  push.addEventListener("keydown", (event) => {
    if (event.key !== " " && event.key !== "Enter") return;
    event.preventDefault();
    if (!event.repeat) hold(true);
  });
  push.addEventListener("keyup", () => hold(false));
  thumb.force.watch((force) => push.setAttribute("aria-pressed", String(force > 0)));
  return push;
}

/** The button in the view: one finger holds it while another moves the needle. Hidden where there is no plunger. */
export function thumbInView(host: HTMLElement, app: App): void {
  const push = thumbButton(app, "Hold to push the plunger", "thumb-button");
  const show = (): void => {
    push.hidden = !thumbOf(app).there;
  };
  for (const signal of [app.hello, app.control, app.source, app.live.scene]) signal.watch(show);
  host.append(push);
}
