import type { Source } from "../state/source.ts";
import type { LabComparison } from "../wire/messages.ts";
import type { Hidden } from "./kit/legend.ts";
import type { Window } from "./window.ts";

/** The window of ticks to draw. Depths in mm; forces in N, positive if they push the needle out. */
export interface TimePicture {
  readonly source: Source;
  readonly window: Window;
  readonly pointed: number | null;
  /** The tick at which the timeline stands. */
  readonly cursor: number | null;
  readonly hidden: Hidden;
  /** Whether the table at the pointed tick leaves the depth out. */
  readonly noDepth: boolean;
  readonly comparison: LabComparison | null;
}

export const MM = 1e3;
export const THUMB_DASH = [8, 3] as const;
export const WIDE = 5; // px: the model's force stays visible behind an equal felt force

export const hasThumb = (source: Source): boolean => Boolean(source.scene.value?.syringe);
