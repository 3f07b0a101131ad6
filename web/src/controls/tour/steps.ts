/** What the tour says, and where. */
export interface Step {
  readonly title: string;
  readonly text: string;
  /** Selectors of what it points at; the first that is in sight counts. */
  readonly at: readonly string[];
  /** A tab that is opened for it. */
  readonly tab?: string;
}

export const STEPS: readonly Step[] = [
  {
    title: "A needle and tissue",
    text: "The needle is at rest in front of the membranes. What you see is computed 1600 times a second, by the model that also makes the force on a haptic device.",
    at: [".panel.view"],
  },
  {
    title: "Push it",
    text: "Drag in the picture: your hand pulls the needle, and the tissue holds it back. It lags, sticks, and then gives way. Turn the mouse wheel to go deeper; the Hand tab has keys and strokes that go by themselves.",
    at: [".panel.view"],
    tab: "hand",
  },
  {
    title: "The pop",
    text: "When the slanted tip is through a membrane the force drops at once: that is the pop. The plots keep every tick of it. The shaded band is all that friction can hold at that depth.",
    at: [".panel.force-depth"],
  },
  {
    title: "Change the tissue",
    text: "Here is the scene. Drag a slider and feel the change at once; the band follows. Undo takes it back.",
    at: [".panel.side"],
    tab: "scene",
  },
];
