/** A step of the tour. */
export interface Step {
  readonly title: string;
  readonly text: string;
  /** Selectors of the part that it explains; the first visible one counts. */
  readonly at: readonly string[];
  /** The tab that it opens. */
  readonly tab?: string;
}

export const STEPS: readonly Step[] = [
  {
    title: "A needle and tissue",
    text:
      "The needle rests in front of the membranes. The view shows the model that makes the force on a haptic device, " +
      "computed 1600 times per second.",
    at: [".panel.view"],
  },
  {
    title: "Push it",
    text:
      "Drag in the view: your hand pulls the needle, and the tissue holds it back. The needle sticks, lags your hand " +
      "and then slips. Turn the mouse wheel to go deeper. The Hand tab has keys and automatic strokes.",
    at: [".panel.view"],
    tab: "hand",
  },
  {
    title: "The pop",
    text:
      "When the slanted tip is through a membrane, the force drops at once: this is the pop. The plots keep every " +
      "tick of it. The shaded band shows the forces at which friction holds the needle at each depth.",
    at: [".panel.force-depth"],
  },
  {
    title: "Change the tissue",
    text: "This is the scene. Drag a slider and feel the change at once; the band follows. Undo reverts it.",
    at: [".panel.side"],
    tab: "scene",
  },
];
