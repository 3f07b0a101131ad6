const FIRST_MS = 250;
const LARGEST_MS = 8000;

/**
 * The wait before attempt n, ms (1 is the first after a loss): doubles, with random jitter so that pages do not
 * all connect at once.
 */
export function waitBefore(attempt: number, chance: () => number = Math.random): number {
  const wait = Math.min(LARGEST_MS, FIRST_MS * 2 ** (attempt - 1));
  return Math.round(wait * (0.8 + 0.4 * chance()));
}
