import type { Hand } from "../hand/hand.ts";
import { button, element } from "../panel.ts";
import type { Preset } from "./camera.ts";

const PRESETS: readonly (readonly [Preset, string, string])[] = [
  ["oblique", "Free", "From the side and a little above"],
  ["side", "Side", "From the side"],
  ["top", "Top", "From above"],
  ["needle", "Needle", "Along the needle"],
];

/** Buttons over the view: the presets, and zoom. Returns their bar. */
export function presets(
  host: HTMLElement,
  look: (preset: Preset) => void,
  zoom: (factor: number) => void,
): HTMLElement {
  const bar = element("div", { class: "view-tools", role: "toolbar", "aria-label": "View" });
  for (const [preset, label, title] of PRESETS) {
    bar.append(button(label, title, () => look(preset)));
  }
  bar.append(
    button("+", "Zoom in", () => zoom(1.3)),
    button("−", "Zoom out", () => zoom(1 / 1.3)),
  );
  host.append(bar);
  return bar;
}

/** A button for fingers, which have no Shift: while it is pressed, a drag moves sideways. */
export function sidewaysButton(bar: HTMLElement, hand: Hand): () => boolean {
  let free = false;
  const title = "A drag moves the needle sideways and not in, as with Shift";
  const press = (): void => {
    free = !free;
    made.setAttribute("aria-pressed", String(free));
  };
  const made = button("Sideways", title, press, "sideways");
  made.setAttribute("aria-pressed", "false");
  hand.barred.watch((why) => {
    made.disabled = why !== null;
  });
  bar.append(made);
  return () => free;
}

/** A button that tells what gestures and keys do. Closed, it covers nothing. */
export const gestureHelp = (): HTMLElement =>
  element(
    "details",
    { class: "view-help" },
    element(
      "summary",
      { "aria-label": "How to move the needle and the view", title: "How to move the needle and the view" },
      "?",
    ),
    element("p", { id: "view-help" }, ...gestureWords()),
  );

/** What gestures do, in one line: for a mouse, and shorter for fingers. The style sheet shows one of them. */
const gestureWords = (): HTMLElement[] => [
  element("span", { class: "by-mouse" }, "Drag, wheel, ↓↑: push, pull · Shift: sideways · right-drag: turn"),
  element("span", { class: "by-touch" }, "Drag: push and pull · two fingers: turn, zoom"),
];
