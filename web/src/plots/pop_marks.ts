import type { MembraneEvent } from "../wire/messages.ts";
import { drawnMembranes, endOf, type ForceDepthPicture } from "./force_depth_picture.ts";
import type { Pane } from "./kit/axes.ts";
import { labelsThatFit } from "./kit/labels.ts";
import type { Pen } from "./kit/pen.ts";
import type { Theme } from "./kit/theme.ts";
import { popLabel } from "./marks.ts";

const MM = 1e3;
const CAP = 5; // px
const SEEN = 14; // px: the words of a smaller drop would lie on the names of the curves

/** Draws the drop of a pop as a line from the force before it to the force after it, at x, px. */
export function drawDrop(pen: Pen, pane: Pane, x: number, event: MembraneEvent, theme: Theme): void {
  const before = pane.y.px(Math.abs(event.force_before));
  const after = pane.y.px(Math.abs(event.force_after));
  const stroke = { colour: theme.text, width: 2 };
  pen.segment(x, before, x, after, stroke);
  for (const y of [before, after]) pen.segment(x - CAP, y, x + CAP, y, stroke);
}

/** The last pop of each drawn membrane in the force against depth: the drop at its depth, and its newtons. */
export function drawPops(pen: Pen, pane: Pane, picture: ForceDepthPicture, theme: Theme): void {
  const { source, window } = picture;
  const end = endOf(picture);
  const pops = drawnMembranes(picture).flatMap((i) => {
    const pop = source.events.value.findLast(
      ({ what, membrane, tick }) => what === "pop" && membrane === i && tick >= window.first && tick < end,
    );
    return pop ? [pop] : [];
  });
  const labels = pops.map((pop) => ({
    x: pane.x.px(pop.depth * MM) + CAP + 4,
    text: popLabel(pop, source.history),
    weight: Math.abs(pop.drop),
  }));
  pen.within(pane.left, pane.top, pane.width, pane.height, () => {
    for (const pop of pops) drawDrop(pen, pane, pane.x.px(pop.depth * MM), pop, theme);
    labelsThatFit(labels, pane.left, pane.left + pane.width).forEach((fits, i) => {
      const { x, text } = labels[i]!;
      // Beside the upper end: the names of the curves are at the forces after the pops.
      const upper = Math.max(pane.top + 8, pane.y.px(Math.abs(pops[i]!.force_before)));
      const high = Math.abs(pane.y.slope * pops[i]!.drop);
      if (fits && high >= SEEN)
        pen.text(x, upper, text, { colour: theme.text, size: 11.5, bold: true, halo: theme.panel });
    });
  });
}
