const WIDEST = 0.6; // mean width of a character of a plot's letters, as a share of their size
const SPACING = 6; // px between two labels

/** The width of a text, px, rather too large than too small. */
export const textWidth = (text: string, size = 11): number => WIDEST * size * text.length;

export interface Label {
  /** Left edge, px. */
  readonly x: number;
  readonly text: string;
  readonly weight: number;
}

/**
 * Tells which labels fit into a row from `left` to `right` (px) without overlap. Labels of greater weight are placed
 * first.
 */
export function labelsThatFit(labels: readonly Label[], left: number, right: number): boolean[] {
  const taken: Array<readonly [from: number, to: number]> = [];
  const fit = new Array<boolean>(labels.length).fill(false);
  const order = labels.map((_, i) => i).sort((a, b) => labels[b]!.weight - labels[a]!.weight);
  for (const i of order) {
    const { x, text } = labels[i]!;
    const end = x + textWidth(text) + SPACING;
    if (x < left || end > right || taken.some(([from, to]) => x < to && end > from)) continue;
    taken.push([x, end]);
    fit[i] = true;
  }
  return fit;
}

/**
 * Moves labels in a column apart, in their order: at least `gap` px between two middles, none below `bottom`. meet:
 * whether two of them can touch at all.
 */
export function apart(
  middles: readonly number[],
  gap: number,
  bottom: number,
  meet: (one: number, other: number) => boolean = () => true,
): number[] {
  const order = middles.map((_, i) => i).sort((a, b) => middles[a]! - middles[b]!);
  const placed = [...middles];
  order.forEach((i, k) => {
    for (const j of order.slice(0, k)) if (meet(i, j)) placed[i] = Math.max(placed[i]!, placed[j]! + gap);
  });
  order.toReversed().forEach((i, k) => {
    placed[i] = Math.min(placed[i]!, bottom);
    for (const j of order.slice(order.length - k)) if (meet(i, j)) placed[i] = Math.min(placed[i]!, placed[j]! - gap);
  });
  return placed;
}
