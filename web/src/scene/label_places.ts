/** A rectangle in the view, CSS pixels. */
export interface Rect {
  readonly left: number;
  readonly top: number;
  readonly right: number;
  readonly bottom: number;
}

/** A label to place: its size, and the point that it names. */
export interface Wish {
  readonly id: string;
  readonly width: number;
  readonly height: number;
  readonly x: number;
  readonly y: number;
  /** beside: next to its point, on this side if possible. column: in the column, with a line to its point. */
  readonly how: "column" | "left" | "right";
}

export interface Place extends Rect {
  readonly id: string;
  /** Where the line from the label to its point begins; null if the label is next to its point. */
  readonly line: readonly [number, number] | null;
}

const GAP = 2; // between two labels
const EDGE = 6; // to the border of the view
const BESIDE = 8; // from a point to its label
const NEAR = 14; // farther from its point, a label has a line

const overlaps = (a: Rect, b: Rect): boolean =>
  a.left < b.right + GAP && b.left < a.right + GAP && a.top < b.bottom + GAP && b.top < a.bottom + GAP;

/**
 * The places of all labels: none overlaps another one or an obstacle, and none leaves the view. Labels of the column
 * keep the order of their points, so that their lines do not cross. A label without any free place is left out.
 */
export function placeLabels(
  wishes: readonly Wish[],
  width: number,
  height: number,
  obstacles: readonly Rect[],
): Place[] {
  const column = wishes.filter(({ how }) => how === "column").sort((a, b) => a.y - b.y || a.x - b.x);
  const places = columnPlaces(column, width, height, obstacles);
  const placed = new Set(places.map(({ id }) => id));
  // A label for which the column has no room goes wherever there is some.
  for (const wish of [...column, ...wishes.filter(({ how }) => how !== "column")]) {
    if (placed.has(wish.id)) continue;
    const place = besidePlace(wish, width, height, [...obstacles, ...places]);
    if (place) places.push(place);
  }
  return places;
}

/** Stacks labels along the right border, each as near to the height of its point as the others permit. */
function columnPlaces(column: readonly Wish[], width: number, height: number, obstacles: readonly Rect[]): Place[] {
  const widest = Math.max(0, ...column.map((label) => label.width));
  const points = column.map(({ x }) => x);
  // Next to the points if there is room, otherwise at the border of the view.
  const left = Math.max(EDGE, Math.min(Math.max(...points) + 2 * BESIDE, width - EDGE - widest));
  const band = { left, right: Math.min(width - EDGE, left + widest) };
  const free = freeParts(band, height, obstacles);
  const tops = stacked(column, free);
  return column.flatMap((label, i): Place[] => {
    const top = tops[i];
    if (top === undefined) return [];
    const rect = { left, top, right: left + label.width, bottom: top + label.height };
    const from = label.x > rect.right ? rect.right : rect.left;
    return [{ id: label.id, ...rect, line: [from, top + label.height / 2] }];
  });
}

/** The vertical parts of a band of the view that no obstacle covers. */
function freeParts(
  band: { left: number; right: number },
  height: number,
  obstacles: readonly Rect[],
): (readonly [number, number])[] {
  const inBand = obstacles
    .filter((other) => other.left < band.right + GAP && band.left < other.right + GAP)
    .sort((a, b) => a.top - b.top);
  const parts: [number, number][] = [];
  let from = EDGE;
  for (const { top, bottom } of inBand) {
    if (top - GAP > from) parts.push([from, top - GAP]);
    from = Math.max(from, bottom + GAP);
  }
  if (from < height - EDGE) parts.push([from, height - EDGE]);
  return parts;
}

/**
 * The tops of labels in order, without overlaps, within the free parts: each near its point. Undefined for a label
 * without room.
 */
function stacked(column: readonly Wish[], free: readonly (readonly [number, number])[]): (number | undefined)[] {
  const tops: (number | undefined)[] = [];
  let part = 0;
  let least = free[0]?.[0] ?? 0;
  // Downwards: the highest place that is free and not above the label's point.
  for (const label of column) {
    let top = Math.max(least, label.y - label.height / 2);
    while (part < free.length && top + label.height > free[part]![1]) {
      if (part + 1 >= free.length) break;
      part++;
      top = Math.max(least, free[part]![0], label.y - label.height / 2);
    }
    tops.push(top);
    least = top + label.height + GAP;
  }
  // Upwards: labels that ran over the lower end move up, into the free parts above.
  part = free.length - 1;
  let most = free[part]?.[1] ?? 0;
  for (let i = column.length - 1; i >= 0; i--) {
    const { height } = column[i]!;
    let bottom = Math.min(most, tops[i]! + height);
    while (part >= 0 && bottom - height < free[part]![0]) {
      part--;
      bottom = Math.min(bottom, free[part]?.[1] ?? Number.NEGATIVE_INFINITY);
    }
    if (part < 0) {
      tops[i] = undefined;
      continue;
    }
    tops[i] = bottom - height;
    most = bottom - height - GAP;
  }
  return tops;
}

/** Next to the point: right or left of it, or at a border of the view, then above or below these places. */
function besidePlace(wish: Wish, width: number, height: number, taken: readonly Rect[]): Place | null {
  const right = wish.x + BESIDE;
  const left = wish.x - BESIDE - wish.width;
  const borders = [Number.POSITIVE_INFINITY, Number.NEGATIVE_INFINITY];
  const sides = [...(wish.how === "left" ? [left, right] : [right, left]), ...borders];
  for (let step = 0; step <= 2 * Math.ceil(height / 8); step++) {
    const shift = (step % 2 ? -1 : 1) * 8 * Math.ceil(step / 2);
    for (const side of sides) {
      const clamped = Math.max(EDGE, Math.min(side, width - EDGE - wish.width));
      const top = wish.y - wish.height / 2 + shift;
      const rect = { left: clamped, top, right: clamped + wish.width, bottom: top + wish.height };
      if (top < EDGE || rect.bottom > height - EDGE || taken.some((other) => overlaps(rect, other))) continue;
      const from = clamped > wish.x ? rect.left : rect.right;
      const far = Math.abs(shift) > NEAR || Math.abs(from - wish.x) > 2 * NEAR;
      return { id: wish.id, ...rect, line: far ? [from, top + wish.height / 2] : null };
    }
  }
  return null;
}
