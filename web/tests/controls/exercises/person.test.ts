import { expect, test } from "vitest";
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
