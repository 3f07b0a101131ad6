import { onePerApp } from "../state/app.ts";
import type { History } from "../state/history.ts";
import { feltForce, scaleOf } from "../state/scale.ts";
import type { Source } from "../state/source.ts";
import type { LabComparison } from "../wire/messages.ts";
import { isCompared } from "./gather.ts";
import { type Curve, Hidden } from "./kit/legend.ts";
import { colourOf, type Theme } from "./kit/theme.ts";
import { nameOf } from "./names.ts";

export const DASH = [5, 3] as const;
export const CUT_SHADE = 0.22;

/** The curves that are switched off in both plots. The force limit is far above the others, so it begins off. */
export const hiddenOf = onePerApp(() => new Hidden("punctura.hidden-curves", ["permitted"]));

/** Name of the solver that runs next to the scene's solver while Compare is on. */
const otherName = (source: Source): string => `${source.scene.value?.solver === "paper" ? "exact" : "paper"} solver`;

/** One curve for each membrane: the model's force along the needle. */
export const membraneCurves = (source: Source, theme: Theme): Curve[] =>
  Array.from({ length: source.history.membranes }, (_, i) => ({
    id: `membrane ${i}`,
    text: nameOf(source, i),
    colour: colourOf(theme, i),
  }));

/** The curves of the forces at the hand, and of the other solver while it runs. */
export function forceCurves(source: Source, first: number, end: number, theme: Theme): Curve[] {
  const curves: Curve[] = [
    { id: "felt", text: feltForce(scaleOf(source)), colour: theme.text },
    { id: "permitted", text: "force limit", colour: theme.danger, dash: DASH },
  ];
  if (isCompared({ history: source.history, first, end }))
    curves.push({ id: "other", text: otherName(source), colour: theme.quiet });
  return curves;
}

/** The mean of the runs that are compared in the laboratory. */
export const meanCurve = (comparison: LabComparison | null, theme: Theme): Curve[] =>
  comparison
    ? [{ id: "mean", text: `mean ± s.d., n = ${comparison.statistics.length}`, colour: theme.quiet, shade: 0.18 }]
    : [];

/** The membranes whose curves are shown. */
export const shownMembranes = ({ membranes }: History, hidden: Hidden): number[] =>
  Array.from({ length: membranes }, (_, i) => i).filter((i) => hidden.shows(`membrane ${i}`));
