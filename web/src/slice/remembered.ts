const KEY = "punctura.slice";

/** Whether the slice is open, as this browser remembers it. */
export function wasOpen(): boolean {
  return store()?.getItem(KEY) === "open";
}

export function remember(open: boolean): void {
  store()?.setItem(KEY, open ? "open" : "closed");
}

/** A browser may forbid storage; the slice then opens closed. */
function store(): Storage | null {
  try {
    return globalThis.localStorage ?? null;
  } catch {
    return null;
  }
}
