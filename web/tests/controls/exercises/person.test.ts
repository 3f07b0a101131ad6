import { expect, test } from "vitest";
import { base64, stemOf } from "../../../src/controls/exercises/open.ts";
import { Person } from "../../../src/controls/exercises/person.ts";

test("the name is kept in the browser, tidied", () => {
  const kept = new Map<string, string>();
  const store = {
    getItem: (key: string) => kept.get(key) ?? null,
    setItem: (key: string, value: string) => void kept.set(key, value),
  };
  new Person(store).set("  Ada   Lovelace ");
  expect(new Person(store).name.value).toBe("Ada Lovelace");
});

test("without a store the name lasts as long as the page", () => {
  const person = new Person(null);
  person.set("Ada");
  expect(person.name.value).toBe("Ada");
});

test("an exercise has the name of its file, without the last ending", () => {
  const files = ["mine.toml", "my.first.TOML", "mine", ".toml", "mine (1).toml"];
  expect(files.map(stemOf)).toEqual(["mine", "my.first", "mine", ".toml", "mine (1)"]);
});

test("all bytes of a long file are in the base64", () => {
  const bytes = Uint8Array.from({ length: 20_001 }, (_, i) => (i * 7) % 256);
  expect(Uint8Array.from(atob(base64(bytes)), (letter) => letter.charCodeAt(0))).toEqual(bytes);
  expect(base64(new Uint8Array())).toBe("");
});
