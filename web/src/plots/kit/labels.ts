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

/** The same for a column in order, in which all can touch: moved up or down, by as little as possible together. */
export function spread(middles: readonly number[], gap: number, bottom: number): number[] {
  // Without the gaps, labels that are moved stand at the mean of what they want.
  const groups: { mean: number; count: number }[] = [];
  middles.forEach((middle, i) => {
    let group = { mean: middle - i * gap, count: 1 };
    for (let above = groups.at(-1); above && above.mean > group.mean; above = groups.at(-1)) {
      const count = above.count + group.count;
      group = { mean: (above.mean * above.count + group.mean * group.count) / count, count };
      groups.pop();
    }
    groups.push(group);
  });
  const most = bottom - (middles.length - 1) * gap;
  return groups
    .flatMap(({ mean, count }) => new Array<number>(count).fill(Math.min(mean, most)))
    .map((place, i) => place + i * gap);
}
