import type { Connection } from "../engine/engine.ts";

/** The displayed texts of the servo states, by their numbers. The mark tells them apart without colour. */
export const STATES: readonly {
  readonly name: string;
  readonly mark: string;
  readonly words: string;
  readonly why: string;
}[] = [
  { name: "disarmed", mark: "❚❚", words: "Force off", why: "The model runs; the device gives no force." },
  { name: "waiting", mark: "◌", words: "Waiting", why: "Force starts once the tip is outside all tissue." },
  { name: "active", mark: "●", words: "Force on", why: "The device gives the force of the model." },
  { name: "faulted", mark: "▲", words: "Fault", why: "The force stays off until you turn it on." },
];

/** Shown instead of "Force on" while a limit cuts the force. */
export const CUT = {
  name: "cut",
  mark: "◐",
  why: "The device gives less than the model's force. Limits protect the hand and the motors: see docs/safety.md.",
} as const;

/** The state of the connection in a few words. leftMs: time until the next attempt. studio: see Engine. */
export function connectionWords(now: Connection, silent: boolean, leftMs: number, studio = true): string {
  switch (now.state) {
    case "open":
      if (!studio) return silent ? "No ticks" : "Runs in this page";
      return silent ? "Connected, but no ticks" : "Connected";
    case "connecting":
      if (!studio) return "Loading the core";
      return now.attempt > 1 ? `Connecting, attempt ${now.attempt}` : "Connecting";
    case "lost":
      return `No connection; retry in ${Math.max(0, Math.ceil(leftMs / 1000))} s`;
    case "refused":
      return studio ? `Refused: ${now.reason}` : `Cannot run: ${now.reason}`;
  }
}
