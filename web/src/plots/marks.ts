import type { MembraneEvent } from "../wire/messages.ts";

const CHARACTER = 6.4; // px, about, of a plot's letters
const AIR = 6;

/** What a pop's mark says: how much the force fell. */
export const popLabel = (event: MembraneEvent): string => `pop −${Math.abs(event.drop).toFixed(2)} N`;

/**
 * The row in which each label is set so that none lies on another; -1 where there is no room. The last label comes first:
 * the newest is never left out. `xs` are left edges, rising, px.
 */
export function rowsOf(labels: ReadonlyArray<{ readonly x: number; readonly text: string }>, rows: number): number[] {
  const free = new Array<number>(rows).fill(Number.POSITIVE_INFINITY); // left edge of what stands in the row already
  const placed = new Array<number>(labels.length).fill(-1);
  for (let i = labels.length - 1; i >= 0; i--) {
    const { x, text } = labels[i]!;
    const right = x + text.length * CHARACTER + AIR;
    const row = free.findIndex((edge) => right <= edge);
    placed[i] = row;
    if (row >= 0) free[row] = x;
  }
  return placed;
}
