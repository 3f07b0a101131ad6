import { keep, storage } from "../state/storage.ts";

const KEY = "punctura.slice";

/** Whether the slice is open, as this browser remembers it. If it may not, the slice is closed at first. */
export function wasOpen(): boolean {
  return storage()?.getItem(KEY) === "open";
}

export function remember(open: boolean): void {
  keep(KEY, open ? "open" : "closed");
}
