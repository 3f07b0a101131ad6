import { expect, it } from "vitest";
import { titleAmong } from "../../../src/controls/exercises/title.ts";

const known = [
  { name: "venipuncture", title: "Venipuncture" },
  { name: "mine", title: "Venipuncture" },
  { name: "epidural", title: "Epidural" },
];

it("adds the name where two exercises have one title, and nowhere else", () => {
  expect(known.map((one) => titleAmong(one, known))).toEqual([
    "Venipuncture (venipuncture)",
    "Venipuncture (mine)",
    "Epidural",
  ]);
});

it("tells the results of a removed exercise from those of one that is there", () => {
  expect(titleAmong({ name: "gone", title: "Epidural" }, known)).toBe("Epidural (gone)");
});
