/** A storage of the browser; null if the page may not use it. */
export function storage(which: "localStorage" | "sessionStorage" = "localStorage"): Storage | null {
  try {
    return globalThis[which] ?? null;
  } catch {
    return null;
  }
}

/** Stores a text. Without storage, or if it is full, the page remembers it only as long as it is open. */
export function keep(key: string, text: string, store: Pick<Storage, "setItem"> | null = storage()): void {
  try {
    store?.setItem(key, text);
  } catch {
    // The storage is full.
  }
}
