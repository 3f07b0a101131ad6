import { buzz, firstGamepad, rumble, Sticks } from "../../hand/gamepad.ts";
import type { Hand } from "../../hand/hand.ts";
import { thumbOf } from "../../hand/thumb.ts";
import { element, everyFrame } from "../../panel.ts";
import type { App } from "../../state/app.ts";
import { Felt } from "./felt.ts";
import { soundOf } from "./sound.ts";

const RIGHT_TRIGGER = 7; // of the standard gamepad
const FULL_TRIGGER = 8; // N. Illustrative

/** Gamepad and sound; sound also works for recordings. */
export function senseRows(app: App, hand: Hand): HTMLElement {
  const sound = soundOf(app);
  const felt = new Felt();
  const sticks = new Sticks(hand);
  const thumb = thumbOf(app);
  const pad = element("output", { class: "pad-name" });
  const loud = element("input", { type: "range", min: 0, max: 1, step: 0.05, value: 0.6, "aria-label": "Volume" });
  const toggle = element("button", { type: "button", class: "button", "aria-pressed": "false" }, "Sound is off");
  loud.addEventListener("input", () => {
    sound.loudness = Number(loud.value);
  });
  const show = (): void => {
    const on = sound.wanted.value === true;
    toggle.setAttribute("aria-pressed", String(on));
    toggle.textContent = on ? "Sound is on" : "Sound is off";
  };
  toggle.addEventListener("click", () => {
    const done = sound.wanted.value ? sound.switchOff() : sound.switchOn();
    void done.catch(() => app.notify("This browser does not let the page play sound."));
  });
  sound.wanted.watch(show);

  let before = performance.now();
  let name = "";
  everyFrame((now) => {
    const seconds = Math.min(0.1, (now - before) / 1000);
    before = now;
    const source = app.source.value;
    const found = firstGamepad();
    if (found) {
      sticks.lead(found, seconds);
      thumb.push("trigger", FULL_TRIGGER * (found.buttons[RIGHT_TRIGGER]?.value ?? 0), now);
    }
    const quiet = app.sitting.value !== null; // in a participant's session nothing but the force tells of a pop
    for (const pop of felt.pops(source)) {
      if (quiet) continue;
      sound.click(pop.drop);
      if (found) rumble(found, pop.drop);
      buzz(pop.drop);
    }
    const plays = !quiet && (source.cursor.value === null || !source.live);
    if (sound.on) sound.setFriction(plays ? felt.power(source) : 0);
    const words = found ? found.id.replace(/\s*\(.*$/, "") : "none; press a button on it";
    if (words === name) return;
    name = words;
    pad.textContent = words;
    pad.title = found
      ? "Left stick: along the needle, to the side. Right stick: tilt, nearer. Right trigger: the plunger. " +
        "It vibrates at a pop."
      : "";
  });
  return element(
    "section",
    { class: "rows" },
    element("h3", {}, "Sound and gamepad"),
    element("div", { class: "row" }, toggle, loud),
    element("div", { class: "row" }, element("span", {}, "Gamepad"), pad),
  );
}
