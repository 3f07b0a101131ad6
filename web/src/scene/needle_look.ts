import type { SceneView } from "../wire/messages.ts";

/** hypodermic: a straight slanted tip. tuohy: a curved tip, centimetre marks, wings and a syringe of saline. */
export type NeedleLook = "hypodermic" | "tuohy";

/** The look of a scene's needle: a Tuohy needle in a scene with an epidural space. */
export const needleLook = ({ membranes }: Pick<SceneView, "membranes">): NeedleLook =>
  membranes.some(({ behind }) => behind === "epidural space") ? "tuohy" : "hypodermic";

/** Distance from the tip to the middle line of the shaft, in diameters. A curved tip lies on that line. */
export const tipOffset = (look: NeedleLook): number => (look === "tuohy" ? 0 : 0.5);
