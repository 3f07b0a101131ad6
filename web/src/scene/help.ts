import { element } from "../panel.ts";
import { gestureWords } from "./gesture_words.ts";

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
