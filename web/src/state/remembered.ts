const YEAR_S = 365 * 24 * 3600;

type Jar = Pick<Document, "cookie">;

/**
 * Small answers that this browser remembers, as cookies: the studio gets another port at each start, and a browser
 * keeps its local storage apart for each port. name and value: letters, digits and underscores.
 */
export function remembered(name: string, jar: Jar = document): string | null {
  const found = jar.cookie.split("; ").find((entry) => entry.startsWith(`punctura_${name}=`));
  return found ? found.slice(found.indexOf("=") + 1) : null;
}

export function remember(name: string, value: string, jar: Jar = document): void {
  jar.cookie = `punctura_${name}=${value}; path=/; max-age=${YEAR_S}; samesite=strict`;
}

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

const KEY = "punctura.token";

/**
 * The token of this run. The studio prints it in the page's address. Here it leaves the address bar, which others can
 * see on a projector, for the storage of this tab, where a reload finds it. Without storage it stays in the address.
 */
export function takeToken(
  page: Pick<Location, "href"> = window.location,
  history: Pick<History, "replaceState" | "state"> = window.history,
  store: Pick<Storage, "getItem" | "setItem"> | null = storage("sessionStorage"),
): string {
  const url = new URL(page.href);
  const given = url.searchParams.get("token");
  if (given === null) return store?.getItem(KEY) ?? "";
  keep(KEY, given, store);
  if (store?.getItem(KEY) === given) {
    url.searchParams.delete("token");
    history.replaceState(history.state, "", url);
  }
  return given;
}
