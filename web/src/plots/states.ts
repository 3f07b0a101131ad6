import type { History } from "../state/history.ts";

/** ServoState of core/punctura/servo/snapshot.hpp. */
export const STATES = ["disarmed", "waiting", "active", "faulted"] as const;
export type State = (typeof STATES)[number];

/** What a state means for the hand, in a word or two. */
export const STATE_WORDS: Readonly<Record<State, string>> = {
  disarmed: "no force",
  waiting: "waiting",
  active: "active",
  faulted: "fault",
};

export const stateOf = (history: History, tick: number): State =>
  STATES[history.byteRow("state", tick)[0] ?? 0] ?? "disarmed";

/** Calls with every stretch of ticks, first to before end, in one state. */
export function eachState(
  history: History,
  first: number,
  end: number,
  use: (state: State, first: number, end: number) => void,
): void {
  const states = history.byteColumn("state");
  for (let from = first; from < end; ) {
    const state = states[history.slot(from)]!;
    let to = from + 1;
    while (to < end && states[history.slot(to)] === state) to++;
    use(STATES[state] ?? "disarmed", from, to);
    from = to;
  }
}
