import type { SceneView } from "../../src/wire/messages.ts";
import venipuncture from "../controls/support/scene.json";

/** The venipuncture without looks: tissue everywhere but in the vein. */
export const plainScene = {
  ...venipuncture,
  membranes: venipuncture.membranes.map((m, i) => ({ ...m, look: "plain", behind: i === 1 ? "blood" : "tissue" })),
} as unknown as SceneView;
