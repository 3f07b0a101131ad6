import { expect, test } from "vitest";
import { bytesText, countText, dateText, eventText, lengthText } from "../../../src/controls/recordings/words.ts";

test("lengths, bytes and counts as people read them", () => {
  expect([lengthText(12.44), lengthText(185)]).toEqual(["12.4 s", "3 min 05 s"]);
  expect(bytesText(3.14e6, 12.4e6)).toBe("3.1 of 12.4 MB");
  expect(bytesText(500, 2000)).toBe("0.5 of 2.0 kB");
  expect(countText(19680)).toBe("19\u202f680");
  expect(countText(0)).toBe("0");
});

test("a date says its year where it is another one", () => {
  const now = new Date("2026-11-21T18:00:00Z");
  expect(dateText("2026-11-21T17:04:00Z", now)).toMatch(/^21 Nov.* 17:04$/);
  expect(dateText("2025-11-21T17:04:00Z", now)).toContain("2025");
  expect(dateText("", now)).toBe("");
});

test("an event in words", () => {
  const event = {
    kind: "event", what: "pop", membrane: 0, name: "skin", tick: 1, time: 1.204, depth: 0,
    force_before: 0.5, force_after: 0.19, drop: 0.31,
  } as const; // biome-ignore format: a record
  expect(eventText(event)).toBe("1.204 s: pop through skin, 0.31 N less");
});
