import type { MembraneEvent } from "../../wire/messages.ts";

/** `21 Nov, 17:04`, with the year if it is not the present one. Empty for an invalid date. */
export function dateText(iso: string, now = new Date()): string {
  const date = new Date(iso);
  if (Number.isNaN(date.getTime())) return "";
  const year = date.getFullYear() === now.getFullYear() ? {} : ({ year: "numeric" } as const);
  return date.toLocaleString("en-GB", { day: "numeric", month: "short", hour: "2-digit", minute: "2-digit", ...year });
}

/** `12.4 s`, `3 min 05 s`. */
export function lengthText(seconds: number): string {
  if (seconds < 60) return `${seconds.toFixed(1)} s`;
  const whole = Math.round(seconds);
  return `${Math.floor(whole / 60)} min ${String(whole % 60).padStart(2, "0")} s`;
}

/** `3.1 of 12.4 MB`. */
export function bytesText(bytes: number, total: number): string {
  const unit = total >= 1e6 ? ([1e6, "MB"] as const) : ([1e3, "kB"] as const);
  return `${(bytes / unit[0]).toFixed(1)} of ${(total / unit[0]).toFixed(1)} ${unit[1]}`;
}

/** 19680 as `19 680`, with a narrow no-break space. */
export const countText = (count: number): string => String(count).replace(/\B(?=(\d{3})+$)/g, "\u202f");

const WHAT: Readonly<Record<MembraneEvent["what"], string>> = {
  touch: "contact with",
  pop: "pop through",
  out: "out of",
};

/** `1.204 s: pop through skin, 0.31 N less`. */
export function eventText(event: MembraneEvent): string {
  const drop = event.what === "pop" && event.drop > 0 ? `, ${event.drop.toFixed(2)} N less` : "";
  return `${event.time.toFixed(3)} s: ${WHAT[event.what]} ${event.name}${drop}`;
}
