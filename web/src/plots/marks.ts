import type { MembraneEvent } from "../wire/messages.ts";

const CHARACTER = 6.4; // px, approximate width of a plot's letters
const SPACING = 6;

/** The label of a pop: the drop of the force. */
export const popLabel = (event: MembraneEvent): string => `pop −${Math.abs(event.drop).toFixed(2)} N`;

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
    const end = x + text.length * CHARACTER + SPACING;
    if (x < left || end > right || taken.some(([from, to]) => x < to && end > from)) continue;
    taken.push([x, end]);
    fit[i] = true;
  }
  return fit;
}
