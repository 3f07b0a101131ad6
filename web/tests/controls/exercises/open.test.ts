import { expect, test } from "vitest";
import { base64, stemOf } from "../../../src/controls/exercises/open.ts";

test("an exercise has the name of its file, without the last ending", () => {
  const files = ["mine.toml", "my.first.TOML", "mine", ".toml", "mine (1).toml"];
  expect(files.map(stemOf)).toEqual(["mine", "my.first", "mine", ".toml", "mine (1)"]);
});

test("all bytes of a long file are in the base64", () => {
  const bytes = Uint8Array.from({ length: 20_001 }, (_, i) => (i * 7) % 256);
  expect(Uint8Array.from(atob(base64(bytes)), (letter) => letter.charCodeAt(0))).toEqual(bytes);
  expect(base64(new Uint8Array())).toBe("");
});
