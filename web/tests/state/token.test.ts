import { describe, expect, it } from "vitest";
import { remember, remembered, takeToken } from "../../src/state/remembered.ts";

const ADDRESS = "http://127.0.0.1:8765/?a=1&token=s3cret#part";

/** The storage of a tab. full: it keeps nothing. */
function tab(full = false) {
  const kept = new Map<string, string>();
  return {
    getItem: (key: string) => kept.get(key) ?? null,
    setItem: (key: string, value: string) => {
      if (full) throw new DOMException("", "QuotaExceededError");
      kept.set(key, value);
    },
  };
}

/** The token, and the address that the bar shows afterwards. */
function load(href: string, store: ReturnType<typeof tab> | null) {
  let shown = href;
  const replaceState = (_: unknown, __: string, url?: string | URL | null) => {
    shown = String(url);
  };
  return { token: takeToken({ href }, { state: null, replaceState }, store), shown };
}

describe("the token of a run", () => {
  it("leaves the address bar, and a reload finds it", () => {
    const store = tab();
    const first = load(ADDRESS, store);
    expect(first).toEqual({ token: "s3cret", shown: "http://127.0.0.1:8765/?a=1#part" });
    expect(load(first.shown, store)).toEqual(first);
    expect(load("http://127.0.0.1:8765/?token=other", store).token).toBe("other");
  });

  it("stays in the address where the page may keep nothing", () => {
    for (const store of [null, tab(true)]) expect(load(ADDRESS, store)).toEqual({ token: "s3cret", shown: ADDRESS });
  });

  it("is empty on a page that was opened without one", () => {
    expect(load("http://127.0.0.1:8765/", tab()).token).toBe("");
  });
});

it("an answer is found again among other cookies, and a missing one is null", () => {
  const jar = { cookie: "other=1; punctura_soundly=off; punctura_sound=on" };
  expect(remembered("sound", jar)).toBe("on");
  expect(remembered("tour", jar)).toBeNull();
});

it("an answer is kept for all ports of this computer, for a year", () => {
  const jar = { cookie: "" };
  remember("sound", "off", jar);
  expect(jar.cookie).toBe("punctura_sound=off; path=/; max-age=31536000; samesite=strict");
});
