import type { SceneView } from "../wire/messages.ts";
import type { Rgb } from "./brush.ts";
import { layersOf, stackOf, vesselOf } from "./layers.ts";
import { toneOf } from "./sheet.ts";

/** A layer as a band beside the anatomy, with the anatomy's name and colour. Depths below the skin, mm. */
export interface Band {
  readonly name: string;
  readonly top: number;
  readonly bottom: number;
  /** The colour of its tissue; null: it is drawn as a sheet in the membrane's colour, or as nothing. */
  readonly tone: Rgb | null;
  /** Index of the membrane in the scene; null for a space between membranes. */
  readonly membrane: number | null;
}

/** The bands of a scene, from the skin down. */
export function bandsOf(scene: SceneView): Band[] {
  const layers = layersOf(scene);
  const artery = layers ? (vesselOf(scene, layers)?.artery ?? false) : false;
  return (layers ?? stackOf(scene)).map((layer) => ({
    name: layer.membrane === null ? spaceName(layer.fill) : scene.membranes[layer.membrane]!.name,
    top: layer.top,
    bottom: layer.bottom,
    tone: layers && toneOf(layer, artery),
    membrane: layer.membrane,
  }));
}

/** A space without a content of its own has no name. */
const spaceName = (fill: string): string => (fill === "tissue" ? "" : fill);

/** The band at a depth, mm; null in front of the skin. */
export const bandAt = (bands: readonly Band[], depth: number): Band | null =>
  depth < 0 ? null : (bands.find(({ bottom }) => depth < bottom) ?? bands.at(-1) ?? null);
