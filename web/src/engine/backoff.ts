const FIRST_MS = 250;
const LARGEST_MS = 8000;

/** How long to wait before attempt n (1 is the first after a loss): doubling, with a little chance, so that pages do not come all at once. */
export function waitBefore(attempt: number, chance: () => number = Math.random): number {
  const wait = Math.min(LARGEST_MS, FIRST_MS * 2 ** (attempt - 1));
  return Math.round(wait * (0.8 + 0.4 * chance()));
}
