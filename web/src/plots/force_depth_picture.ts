import type { Source } from "../state/source.ts";
import type { LabBand, LabComparison } from "../wire/messages.ts";
import { codeOf } from "../wire/ticks.ts";
import { shownMembranes } from "./curves.ts";
import type { Hidden } from "./kit/legend.ts";
import type { Window } from "./window.ts";

const OUTSIDE = codeOf("phase", "outside");

export interface Area {
  readonly x: readonly [number, number];
  readonly y: readonly [number, number];
}

/** The ticks to draw. Depths in mm; forces in N, positive if they push the needle out. */
export interface ForceDepthPicture {
  readonly source: Source;
  readonly window: Window;
  /** The present tick. Later ticks are not drawn. */
  readonly shown: number | null;
  /** One membrane, or null for all. */
  readonly chosen: number | null;
  readonly overlay: Source | null;
  readonly comparison: LabComparison | null;
  readonly zoom: Area | null;
  /** Opacity of the oldest tick, 0 to 1. */
  readonly oldest: number;
  readonly pointed: { readonly tick: number; readonly membrane: number } | null;
  readonly hidden: Hidden;
}

/** The membranes that are drawn. */
export const drawnMembranes = ({ source, chosen, hidden }: ForceDepthPicture): number[] =>
  chosen === null ? shownMembranes(source.history, hidden) : chosen < source.history.membranes ? [chosen] : [];

/** Those whose friction band is drawn. With more than two, the bands would cover each other: then the present one. */
export function bandedMembranes(picture: ForceDepthPicture): number[] {
  const all = drawnMembranes(picture);
  const { history } = picture.source;
  if (all.length < 3 || history.length === 0) return all;
  const phase = history.byteRow("phase", Math.max(history.first, endOf(picture) - 1));
  return [all.findLast((i) => phase[i] !== OUTSIDE) ?? all[0]!];
}

/** The matching membranes of the earlier run: those with the same name, else with the same index. */
export function overlaidMembranes(picture: ForceDepthPicture): number[] {
  const { source, overlay } = picture;
  if (!overlay) return [];
  const names = overlay.scene.value?.membranes.map(({ name }) => name) ?? [];
  return drawnMembranes(picture)
    .map((i) => {
      const named = names.indexOf(source.scene.value?.membranes[i]?.name ?? "");
      return named < 0 ? i : named;
    })
    .filter((i) => i < overlay.history.membranes);
}

/** The tick after the last drawn one. */
export function endOf({ window, shown }: ForceDepthPicture): number {
  return shown === null ? window.end : Math.max(window.first, Math.min(window.end, shown + 1));
}

/** The mean of several runs for each drawn membrane that they have under the same name. */
export function meanBands(
  picture: ForceDepthPicture,
): readonly { readonly membrane: number; readonly band: LabBand }[] {
  const { source, comparison, hidden } = picture;
  if (!comparison || !hidden.shows("mean")) return [];
  return drawnMembranes(picture).flatMap((membrane) => {
    const name = source.scene.value?.membranes[membrane]?.name;
    const band = comparison.depth.membranes.find((one) => one.name === name);
    return band ? [{ membrane, band }] : [];
  });
}
