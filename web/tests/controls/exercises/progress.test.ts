import { expect, test } from "vitest";
import { courses, drawProgress, MEASURES, summaries } from "../../../src/controls/exercises/progress_part.ts";
import { SvgPen } from "../../../src/plots/kit/svg_pen.ts";
import { CSS_THEME } from "../../../src/plots/kit/theme.ts";
import type { Result } from "../../../src/wire/messages.ts";

const attempt = (person: string, day: number, passed: boolean, overshoot: number | null, exercise = "vein"): Result =>
  ({
    person,
    exercise,
    passed,
    date: `2026-01-${String(day).padStart(2, "0")}T10:00:00Z`,
    metrics: { overshoot: overshoot === null ? [] : [{ distance: 0.5e-3 }, { distance: overshoot }] },
  }) as unknown as Result;

const RESULTS = [
  attempt("Bob", 4, true, 1e-3),
  attempt("Ada", 5, true, 2e-3),
  attempt("Ada", 1, false, 4e-3),
  attempt("Bob", 3, false, 0.1e-3), // given up at once
  attempt("Ada", 3, false, null),
  attempt("Ada", 2, true, 9e-3, "other"),
];
const OVERSHOOT = MEASURES[0]!;

test("each person's attempts at an exercise are numbered from the oldest on", () => {
  const [ada, bob] = courses(RESULTS, "vein", OVERSHOOT);
  expect(ada?.person).toBe("Ada");
  expect(ada?.points.map(({ number, value }) => [number, value])).toEqual([
    [1, 4],
    [3, 2], // the second has no overshoot, but is counted
  ]);
  expect(bob?.points).toHaveLength(2);
});

test("the table has attempts, passes, the first pass, the best pass and the last value of each person", () => {
  expect(summaries(RESULTS, "vein", OVERSHOOT)).toEqual([
    { person: "Ada", attempts: 3, passed: 1, firstPass: 3, best: 2, last: 2 },
    { person: "Bob", attempts: 2, passed: 1, firstPass: 2, best: 1, last: 1 },
  ]);
  expect(summaries([attempt("", 1, false, null)], "vein", OVERSHOOT)).toEqual([
    { person: "", attempts: 1, passed: 0, firstPass: null, best: null, last: null },
  ]);
});

test("a pass is a full dot, and an attempt that was not passed an empty one", () => {
  const pen = new SvgPen();
  const words = drawProgress(pen, 300, 180, CSS_THEME, RESULTS, "vein", OVERSHOOT);
  const file = pen.file(300, 180, "none", words, "");
  expect(words).toBe("Largest overshoot, mm over 4 attempts. Smaller is better.");
  expect(file.match(/<circle/g)).toHaveLength(6); // four dots, and the holes of the two that are not passed
  for (const [i, name] of ["Ada", "Bob"].entries()) // each name in the colour of its line, as in the table
    expect(file).toMatch(new RegExp(`fill="var\\(--data-${i + 1}\\)"[^>]*>${name}<`));
});
