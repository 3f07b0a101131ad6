import type { Spread, Status } from "../../wire/messages.ts";
import { leftOutWords, NOTES } from "./words.ts";

/** No times: ticks of a block begin at once, and a browser's clock is too coarse for one of them. */
const NOT_MEASURED: Spread = { p50: 0, p99: 0, p99_9: 0, largest: 0, edges: [], counts: [] };

/** What the page's run tells of itself. busyMs: computing time of all ticks. leftOut: ticks. */
export interface RunFigures {
  readonly ticks: number;
  readonly busyMs: number;
  readonly leftOut: number;
  readonly armed: boolean;
  readonly hand: Status["hand"];
  readonly compare: boolean;
}

export function statusOf({ ticks, busyMs, leftOut, armed, hand, compare }: RunFigures): Status {
  const statements = [...NOTES, "ticks are computed in blocks, in a worker of this page"];
  if (ticks > 0) statements.push(`computing a tick takes ${((1e3 * busyMs) / ticks).toFixed(1)} µs on average`);
  if (leftOut > 0) statements.push(leftOutWords(leftOut));
  return {
    kind: "status",
    ticks,
    late: 0,
    lost: leftOut,
    period: NOT_MEASURED,
    compute: NOT_MEASURED,
    viewers: 1,
    dropped: 0,
    armed,
    hand,
    compare,
    statements,
    second: null,
  };
}
