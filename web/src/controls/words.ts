import type { Connection } from "../engine/engine.ts";

/** ServoState of core/punctura/servo/snapshot.hpp, in words; the mark tells them apart without colour. */
export const STATES: readonly {
  readonly name: string;
  readonly mark: string;
  readonly words: string;
  readonly why: string;
}[] = [
  { name: "disarmed", mark: "❚❚", words: "Paused", why: "The model runs; the hand gets no force." },
  { name: "waiting", mark: "◌", words: "Waiting", why: "Force begins once the tip is outside all tissue." },
  { name: "active", mark: "●", words: "Force on", why: "The hand gets the force of the model." },
  { name: "faulted", mark: "▲", words: "Fault", why: "The force is zero until the fault is reset." },
];

/** In place of "Force on" while a limit cuts the force: what comes to the hand, and which limit it is. */
export const CUT = {
  name: "cut",
  mark: "◐",
  why: "The hand gets less than the model's force. Limits protect the hand and the motors of the device; docs/safety.md has them.",
} as const;

/** How the page stands with the studio, in a few words. leftMs: until the next attempt. */
export function connectionWords(now: Connection, silent: boolean, leftMs: number): string {
  switch (now.state) {
    case "open":
      return silent ? "Connected, but no ticks come" : "Connected";
    case "connecting":
      return now.attempt > 1 ? `Connecting, attempt ${now.attempt}` : "Connecting";
    case "lost":
      return `No connection; again in ${Math.max(0, Math.ceil(leftMs / 1000))} s`;
    case "refused":
      return `Refused: ${now.reason}`;
  }
}
