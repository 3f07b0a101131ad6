import type { MembraneView, SceneView } from "../wire/messages.ts";

/** The kind of a drawn layer: the look of a membrane, or the content of the space behind one. */
export type Fill = MembraneView["look"] | MembraneView["behind"];

/** A layer of the drawn block. Depths in mm from the first surface, along the inward normal. */
export interface Layer {
  readonly fill: Fill;
  /** Index of the membrane in the scene; null for a space between membranes. */
  readonly membrane: number | null;
  readonly top: number;
  readonly bottom: number;
}

/** A blood vessel that lies along the cut: the wall's and the lumen's depths, mm. */
export interface Vessel {
  readonly walls: readonly [number, number];
  readonly outer: readonly [number, number];
  readonly inner: readonly [number, number];
  readonly artery: boolean;
}

const MM = 1000;
const PARALLEL = 0.9998; // cosine of 1.1 degrees
const THINNEST = 0.12; // drawn thickness of a membrane without thickness, mm
const LEAST_BELOW = 6; // drawn depth behind the last membrane, mm

/**
 * The layers of a scene from the surface down, or null if it is drawn as sheets: because every membrane has the look
 * "plain", or because the membranes are not parallel.
 */
export function layersOf(scene: Pick<SceneView, "membranes">): Layer[] | null {
  const normal = scene.membranes[0]?.inward_normal;
  if (!normal || scene.membranes.every(({ look }) => look === "plain")) return null;
  if (scene.membranes.some((m) => dot(m.inward_normal, normal) < PARALLEL)) return null;
  return stackOf(scene);
}

const tissues = new WeakMap<SceneView, SceneView>();

/** The same scene with sheets drawn as tissue; the same object for the same scene. */
export function asTissue(scene: SceneView): SceneView {
  if (scene.membranes.some(({ look }) => look !== "plain")) return scene;
  const made = tissues.get(scene) ?? {
    ...scene,
    membranes: scene.membranes.map((membrane) => ({ ...membrane, look: "fascia" as const })),
  };
  tissues.set(scene, made);
  return made;
}

/** The layers by the depths of their front faces along the first membrane's normal, also of sheets. */
export function stackOf({ membranes }: Pick<SceneView, "membranes">): Layer[] {
  const first = membranes[0];
  if (!first) return [];
  const normal = first.inward_normal;
  const depth = (m: MembraneView): number => dot(sub(m.point, first.point), normal) * MM;
  const order = membranes.map((m, i) => ({ m, i, top: depth(m) })).sort((a, b) => a.top - b.top);
  const start = order[0]!.top;
  const layers: Layer[] = [];
  order.forEach(({ m, i, top }, at) => {
    const next = order[at + 1];
    const room = next ? next.top - top : Number.POSITIVE_INFINITY;
    const bottom = top + Math.min(room, Math.max(m.thickness * MM, THINNEST));
    if (bottom > top) layers.push({ fill: m.look, membrane: i, top: top - start, bottom: bottom - start });
    const end = next ? next.top : bottom + Math.max(LEAST_BELOW, 0.16 * (bottom - start));
    if (end > bottom + 1e-6) layers.push({ fill: m.behind, membrane: null, top: bottom - start, bottom: end - start });
  });
  return layers;
}

/** The vessel of a scene: its walls have the look of a vein or an artery, and blood lies between them. */
export function vesselOf(scene: Pick<SceneView, "lumen">, layers: readonly Layer[]): Vessel | null {
  const [front, back] = scene.lumen.map((wall) => layers.find(({ membrane }) => membrane === wall));
  if (!front || !back || !isWall(front.fill) || front.fill !== back.fill || front.bottom >= back.top) return null;
  return {
    walls: [front.membrane!, back.membrane!],
    outer: [front.top, back.bottom],
    inner: [front.bottom, back.top],
    artery: front.fill === "artery wall",
  };
}

const isWall = (fill: Fill): boolean => fill === "vein wall" || fill === "artery wall";

type Triple = readonly number[];
const dot = (a: Triple, b: Triple): number => a[0]! * b[0]! + a[1]! * b[1]! + a[2]! * b[2]!;
const sub = (a: Triple, b: Triple): Triple => a.map((x, i) => x - b[i]!);
