import { fixedNumber } from "../../format.ts";
import { thumbOf } from "../../hand/thumb.ts";
import { thumbButton } from "../../hand/thumb_button.ts";
import { element, everyFrame } from "../../panel.ts";
import type { App } from "../../state/app.ts";

const INTERVAL = 100; // ms between updates; faster ones cannot be read

/** Whether the syringe is empty. injected, volume: m³. Air takes less room under pressure. */
const isEmpty = (injected: number, volume: number): boolean => injected > 0.9 * volume;

/** The syringe, in scenes that have one: a button that pushes while it is held, and what the thumb feels. */
export function plungerRows(app: App): HTMLElement {
  const thumb = thumbOf(app);
  const push = thumbButton(app, "Hold to push", "button");

  const keys = element("div", { class: "row" }, push, "or, in the view: its button, Space, or the wheel with Alt");
  const second = element("p", { class: "quiet" });
  app.hello.watch((hello) => {
    const model = hello?.second_device ?? "";
    keys.hidden = model !== "";
    second.hidden = model === "";
    second.textContent = `The second device pushes the plunger: ${model}. Keys, wheel and trigger do not.`;
  });

  const force = element("output", { class: "figure" }, "– N");
  const refill = "Empty. Load the scene again to fill it.";
  const empty = element("p", { class: "quiet", role: "status", hidden: true }, refill);
  const volume = element("output", { class: "figure" }, "– mL");
  const host = element(
    "section",
    { class: "rows", hidden: true },
    element("h3", {}, "Syringe"),
    keys,
    second,
    element("div", { class: "row" }, element("span", {}, "Thumb, model force"), force),
    element("div", { class: "row" }, element("span", {}, "Injected"), volume),
    empty,
  );
  const put = (where: HTMLElement, text: string): void => {
    if (where.textContent !== text) where.textContent = text;
  };
  let last = 0;
  everyFrame((now) => {
    thumb.renew(now);
    if (now - last < INTERVAL) return;
    last = now;
    const source = app.source.value;
    host.hidden = !source.scene.value?.syringe;
    const tick = host.hidden ? null : source.shown();
    if (tick === null || host.offsetParent === null) return;
    put(force, `${fixedNumber(Math.abs(source.history.row("thumb_force", tick)[0] ?? Number.NaN), 2)} N`);
    empty.hidden = !isEmpty(source.history.row("injected", tick)[0] ?? 0, source.scene.value?.syringe?.volume ?? 1);
    put(volume, `${fixedNumber((source.history.row("injected", tick)[0] ?? Number.NaN) * 1e6, 2)} mL`);
    push.toggleAttribute("disabled", !thumb.there);
  });
  return host;
}
