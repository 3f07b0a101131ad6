import type { SceneView } from "../wire/messages.ts";

/** hypodermic: a straight slanted tip. tuohy: a curved tip, centimetre marks, wings and a syringe of saline. */
export type NeedleLook = "hypodermic" | "tuohy";

/** The look of a scene's needle: the key `look` of its file's needle table. */
export function needleLook(scene: SceneView): NeedleLook {
  const needle = scene.tables.needle as { look?: unknown } | undefined;
  return needle?.look === "tuohy" ? "tuohy" : "hypodermic";
}

/** Distance from the tip to the middle line of the shaft, in diameters. A curved tip lies on that line. */
export const tipOffset = (look: NeedleLook): number => (look === "tuohy" ? 0 : 0.5);
