import { element } from "../panel.ts";

/** What gestures do, in one line: for a mouse, and shorter for fingers. The style sheet shows one of them. */
export const gestureWords = (): HTMLElement[] => [
  element("span", { class: "by-mouse" }, "Drag, wheel, ↓↑: push, pull · Shift: sideways · right-drag: turn"),
  element("span", { class: "by-touch" }, "Drag: push and pull · two fingers: turn, zoom"),
];
