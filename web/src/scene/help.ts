import { element } from "../panel.ts";

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
