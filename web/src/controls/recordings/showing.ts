import { leaveExcerpt } from "../../pop/again.ts";
import type { App } from "../../state/app.ts";
import type { Source } from "../../state/source.ts";
import { MOMENT_SLOWDOWNS, SLOWDOWNS, SPEEDS } from "./playback.ts";

/** How the replay bar shows a source: a whole recording, or an excerpt around a pop. */
export interface Showing {
  readonly first: number;
  readonly last: number;
  /** Words in front of the title. */
  readonly kind: string;
  readonly speeds: ReadonlyArray<readonly [speed: number, words: string]>;
  speed: number;
  /** The time of a tick. */
  time(tick: number): string;
  spokenTime(tick: number): string;
  readonly backWords: string;
  readonly backTitle: string;
  back(): void;
  /** After its end it goes back by itself, unless the user has used the bar. */
  readonly goesBack: boolean;
}

let slowdown: number = SLOWDOWNS[1]; // the last one that the user chose
let momentSlowdown: number = MOMENT_SLOWDOWNS[0];

export const showingOf = (app: App, source: Source): Showing =>
  source.excerpt ? excerptShowing(app, source, source.excerpt) : recordingShowing(app, source);

function recordingShowing(app: App, { history, paused }: Source): Showing {
  const start = history.timeOf(history.first);
  const total = (history.timeOf(history.end - 1) - start).toFixed(3);
  const at = (tick: number): string => (history.timeOf(tick) - start).toFixed(3);
  return {
    first: history.first,
    last: Math.max(history.end - 1, history.first),
    kind: paused ? "" : "Replay of",
    speeds: SPEEDS.map((speed) => [speed, `${speed}×`]),
    speed: 1,
    time: (tick) => `${at(tick).padStart(total.length, " ")} / ${total} s`,
    spokenTime: (tick) => `${at(tick)} of ${total} seconds`,
    backWords: "Back to live",
    backTitle: "",
    back: () => app.goLive(),
    goesBack: false,
  };
}

function excerptShowing(app: App, { history }: Source, excerpt: NonNullable<Source["excerpt"]>): Showing {
  const pop = excerpt.event !== null;
  const middle = history.timeOf(excerpt.tick);
  const backWords = excerpt.of.live
    ? "Back to live"
    : excerpt.of.paused
      ? "Back to the pause"
      : "Back to the recording";
  const ms = (tick: number): string => {
    const text = ((history.timeOf(tick) - middle) * 1e3).toFixed(1);
    return `${text.startsWith("-") ? "−" : "+"}${text.replace("-", "").padStart(4, "\u2007")}`;
  };
  return {
    first: excerpt.first,
    last: excerpt.last,
    kind: pop ? "Pop again:" : "The moment, slowly:",
    speeds: (pop ? SLOWDOWNS : MOMENT_SLOWDOWNS).map((times) => [1 / times, `${times}× slower`]),
    get speed() {
      return 1 / (pop ? slowdown : momentSlowdown);
    },
    set speed(speed) {
      if (pop) slowdown = Math.round(1 / speed);
      else momentSlowdown = Math.round(1 / speed);
    },
    time: (tick) => `${ms(tick)} ms`,
    spokenTime: (tick) => `${ms(tick).replaceAll("\u2007", "")} milliseconds from the ${pop ? "pop" : "moment"}`,
    backWords,
    backTitle: `${backWords} (Escape)`,
    back: () => leaveExcerpt(app),
    goesBack: true,
  };
}
