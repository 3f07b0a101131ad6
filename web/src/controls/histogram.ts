import { Pane } from "../plots/kit/axes.ts";
import { textWidth } from "../plots/kit/labels.ts";
import type { Pen } from "../plots/kit/pen.ts";
import { colourOf, type Theme } from "../plots/kit/theme.ts";
import type { Spread } from "../wire/messages.ts";

const LABEL = 18; // px for the label below the axis
const LEAST = 0.1; // height of a count of one, as a share of the box
const EDGE = 0.995; // bins beyond the ends of the axis are drawn at the ends

/**
 * Draws a distribution of times on a logarithmic axis, with a mark at the nominal time. Heights are logarithmic too,
 * so that one late tick in a million is visible.
 */
export function drawHistogram(
  pen: Pen,
  { edges, counts, p50, largest }: Spread,
  nominal: number,
  words: (seconds: number) => string,
  width: number,
  height: number,
  theme: Theme,
): void {
  const pane = new Pane();
  pane.place(0, 0, width, height - LABEL);
  pane.rangeX(Math.min(p50, nominal) / 8, Math.max(largest, nominal) * 2, true);
  const tallest = Math.log10(Math.max(...counts, 1));
  const place = (time: number): number => Math.min(Math.max(pane.x.px(Math.max(time, 1e-12)), 0), width);
  counts.forEach((count, i) => {
    if (count <= 0) return;
    const left = Math.min(place(edges[i]!), EDGE * width);
    const tall = (tallest > 0 ? LEAST + ((1 - LEAST) * Math.log10(count)) / tallest : 1) * pane.height;
    const wide = Math.max(place(edges[i + 1] ?? edges[i]!) - left - 0.4, 1);
    pen.box(left, pane.bottom - tall, wide, tall, colourOf(theme, 0), 1);
  });
  pen.segment(0, pane.bottom, width, pane.bottom, { colour: theme.line, width: 1 });
  const mark = pane.x.px(nominal);
  pen.segment(mark, 0, mark, pane.bottom, { colour: colourOf(theme, 1), width: 1.5, dash: [4, 3] });
  const text = `${words(nominal)}: the period`;
  const x = Math.min(mark, width - textWidth(text));
  pen.text(x, height - LABEL / 2, text, { colour: theme.quiet });
}
