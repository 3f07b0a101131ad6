import type { Spread, Status } from "../../wire/messages.ts";

/** What a page without a server says where the studio on a computer is needed. */
const GET_STUDIO = "Install Punctura on your computer and start “punctura run”.";

const NOTES = [
  "The core runs in this page as WebAssembly, on a simulated device in a simulated hand.",
  `A haptic device needs the studio. ${GET_STUDIO}`,
];

export const NEEDS_STUDIO = `This needs the studio, and this page has none. ${GET_STUDIO}`;

export const EXERCISE_FILE = `This is an exercise, not a scene. ${NEEDS_STUDIO}`;

/** leftOut: ticks. */
const leftOutWords = (leftOut: number): string =>
  `${leftOut.toLocaleString("en")} ticks were left out, because the browser gave this page no time`;

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
