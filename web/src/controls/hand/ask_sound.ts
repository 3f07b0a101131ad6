import { button, element, type Panel } from "../../panel.ts";
import { soundOf } from "./sound.ts";

/**
 * Asks once, after the first pop, whether the page may play sound. The answer is remembered. The question is a bar
 * below the page.
 */
export const askSound: Panel = (root, app) => {
  const sound = soundOf(app);
  const yes = (): void => {
    void sound.switchOn().catch(() => app.notify("This browser does not let the page play sound."));
  };
  const box = element(
    "section",
    { class: "ask-sound", "aria-label": "Sound", hidden: true },
    element("p", {}, "Do you want to hear the pops and the friction?"),
    button("Sound on", "", yes, "primary"),
    button("No sound", "", () => void sound.switchOff()),
  );
  root.after(box);
  let popped = false;
  const show = (): void => {
    box.hidden = !popped || sound.wanted.value !== null || app.sitting.value !== null;
  };
  app.live.events.watch((events) => {
    popped ||= events.some(({ what }) => what === "pop");
    show();
  });
  sound.wanted.watch(show);
};
