import { keep, storage } from "./remembered.ts";

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
