import type { History } from "../state/history.ts";
import { LIMITS, type Limit } from "../state/limits.ts";
import { wordsOf } from "../wire/ticks.ts";

/** ServoState of core/punctura/servo/snapshot.hpp. */
const STATES = wordsOf("state");
export type State = (typeof STATES)[number];

/** The meaning of each state for the force, in one or two words. */
export const STATE_WORDS: Readonly<Record<State, string>> = {
  disarmed: "no force",
  waiting: "waiting",
  active: "active",
  faulted: "fault",
};

export const stateOf = (history: History, tick: number): State =>
  STATES[history.byteRow("state", tick)[0] ?? 0] ?? "disarmed";

/** Calls `use` for each run of consecutive ticks in one state, from `first` up to but not including `end`. */
export function eachState(
  history: History,
  first: number,
  end: number,
  use: (state: State, first: number, end: number) => void,
): void {
  eachStretch(history, "state", first, end, (state, from, to) => use(STATES[state] ?? "disarmed", from, to));
}

/** Calls `use` for each run of consecutive ticks with the same limit. */
export function eachLimit(
  history: History,
  first: number,
  end: number,
  use: (limit: Limit, first: number, end: number) => void,
): void {
  eachStretch(history, "limit", first, end, (limit, from, to) => use(LIMITS[limit] ?? "unknown", from, to));
}

function eachStretch(
  history: History,
  column: "state" | "limit",
  first: number,
  end: number,
  use: (value: number, first: number, end: number) => void,
): void {
  const values = history.byteColumn(column);
  for (let from = first; from < end; ) {
    let slot = history.slot(from);
    const value = values[slot]!;
    let to = from;
    do {
      to++;
      slot = slot + 1 < history.capacity ? slot + 1 : 0; // a call of slot() for each tick would take most of the time
    } while (to < end && values[slot] === value);
    use(value, from, to);
    from = to;
  }
}
