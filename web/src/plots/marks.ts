import type { MembraneEvent } from "../wire/messages.ts";

const CHARACTER = 6.4; // px, about, of a plot's letters
const AIR = 6;

/** What a pop's mark says: how much the force fell. */
export const popLabel = (event: MembraneEvent): string => `pop −${Math.abs(event.drop).toFixed(2)} N`;

export interface Label {
  /** Left edge, px. */
  readonly x: number;
  readonly text: string;
  readonly weight: number;
}

/**
 * Which labels fit into a row from `left` to `right` (px) so that none lies on another: the weightiest are never
 * left out.
 */
export function labelsThatFit(labels: readonly Label[], left: number, right: number): boolean[] {
  const taken: Array<readonly [from: number, to: number]> = [];
  const fit = new Array<boolean>(labels.length).fill(false);
  const order = labels.map((_, i) => i).sort((a, b) => labels[b]!.weight - labels[a]!.weight);
  for (const i of order) {
    const { x, text } = labels[i]!;
    const end = x + text.length * CHARACTER + AIR;
    if (x < left || end > right || taken.some(([from, to]) => x < to && end > from)) continue;
    taken.push([x, end]);
    fit[i] = true;
  }
  return fit;
}
