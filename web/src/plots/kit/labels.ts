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
 * Moves labels in a column apart, in their order and by as little as possible together: at least `gap` px between two
 * middles, from `top` to `bottom`. Labels that do not meet, not even through others, are in columns of their own.
 */
export function apart(
  middles: readonly number[],
  gap: number,
  [top, bottom]: readonly [top: number, bottom: number],
  meet: (one: number, other: number) => boolean = () => true,
): number[] {
  let columns: number[][] = [];
  middles.forEach((_, i) => {
    const meets = columns.filter((column) => column.some((j) => meet(i, j)));
    columns = [...columns.filter((column) => !meets.includes(column)), [...meets.flat(), i]];
  });
  const placed = [...middles];
  for (const column of columns) {
    column.sort((a, b) => middles[a]! - middles[b]!);
    // Without the gaps, labels that are moved stand at the mean of what they want.
    const groups: { mean: number; count: number }[] = [];
    column.forEach((i, k) => {
      let group = { mean: middles[i]! - k * gap, count: 1 };
      for (let above = groups.at(-1); above && above.mean > group.mean; above = groups.at(-1)) {
        const count = above.count + group.count;
        group = { mean: (above.mean * above.count + group.mean * group.count) / count, count };
        groups.pop();
      }
      groups.push(group);
    });
    const most = bottom - (column.length - 1) * gap;
    const places = groups.flatMap(({ mean, count }) => new Array<number>(count).fill(Math.max(mean, top)));
    column.forEach((i, k) => {
      placed[i] = Math.min(places[k]!, most) + k * gap;
    });
  }
  return placed;
}
