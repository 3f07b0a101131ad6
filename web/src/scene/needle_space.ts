import type { LawCurve, MembraneView, SceneView } from "../wire/messages.ts";
import { BARRED, MM, type Moment, OUTSIDE } from "./moment.ts";

export type Content = "outside" | MembraneView["behind"];

/** What the tip's opening lies in. */
export interface AtTip {
  /** Outside, in a membrane ("tissue"), or in a space with the content that the scene gives. */
  readonly content: Content;
  /** Share of the opening that is past the membrane in front of the space, from 0 to 1. */
  readonly open: number;
}

/**
 * What the tip is in. It is in a space if its point is past the far face of the deepest membrane that it has entered.
 * laws: give the far faces along the needle.
 */
export function atTip(moment: Moment, scene: SceneView, laws: readonly LawCurve[]): AtTip {
  const entered = moment.membranes.flatMap(({ phase, depth }, i) => {
    const far = laws[i]?.far_face;
    if (phase === OUTSIDE || phase === BARRED || far === undefined) return [];
    return [{ i, past: depth - far * MM, deep: frontDepth(scene, i) }];
  });
  const last = entered.reduce<(typeof entered)[number] | null>((a, b) => (a && a.deep >= b.deep ? a : b), null);
  if (!last) return { content: "outside", open: 0 };
  if (last.past <= 0) return { content: "tissue", open: 0 };
  return { content: scene.membranes[last.i]!.behind, open: Math.min(1, last.past / (scene.tip_length * MM)) };
}

/** Depth of a membrane's front face below the first one's, m. */
function frontDepth({ membranes }: SceneView, index: number): number {
  const normal = membranes[0]?.inward_normal ?? [0, -1, 0];
  const from = membranes[0]?.point ?? [0, 0, 0];
  return membranes[index]!.point.reduce((sum, value, axis) => sum + (value - from[axis]!) * normal[axis]!, 0);
}
