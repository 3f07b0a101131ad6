import type { Result } from "../../wire/messages.ts";

/** A measure whose course over the attempts is shown. In the unit of its label; smaller is better. */
export interface Measure {
  readonly key: string;
  readonly label: string;
  readonly of: (result: Result) => number | null;
}

export const MEASURES: readonly Measure[] = [
  { key: "overshoot", label: "Largest overshoot, mm", of: ({ metrics }) => largest(metrics.overshoot) },
  { key: "force", label: "Peak model force, N", of: ({ metrics }) => metrics.peak_force },
  { key: "time", label: "Total time, s", of: ({ metrics }) => metrics.total_time },
  { key: "arrival", label: "Time to the space, s", of: ({ metrics }) => metrics.time_to_target },
  { key: "entries", label: "Entries", of: ({ metrics }) => metrics.entries },
  { key: "aside", label: "Lateral deviation, mm", of: ({ metrics }) => times(metrics.lateral_deviation, 1e3) },
];

const largest = (overshoot: readonly { readonly distance: number }[]): number | null =>
  overshoot.length ? Math.max(...overshoot.map(({ distance }) => distance)) * 1e3 : null;
const times = (value: number | null, factor: number): number | null => (value === null ? null : value * factor);

/** One attempt in the chart. */
export interface Point {
  /** 1 for the first attempt of the person. */
  readonly number: number;
  readonly value: number;
  readonly result: Result;
}

/** The attempts of each person at one exercise, the oldest first. Attempts without the measure are left out. */
export function courses(
  results: readonly Result[],
  exercise: string,
  { of }: Measure,
): { person: string; points: Point[] }[] {
  return byPerson(results.filter((result) => result.exercise === exercise)).map(([person, attempts]) => ({
    person,
    points: attempts.flatMap((result, i) => {
      const value = of(result);
      return value === null ? [] : [{ number: i + 1, value, result }];
    }),
  }));
}

/** One row of the table. */
export interface Summary {
  readonly person: string;
  readonly attempts: number;
  readonly passed: number;
  /** Number of the attempt that passed first; null: none. */
  readonly firstPass: number | null;
  /** Of the attempts that were passed: one that was given up at once has the least time and force. */
  readonly best: number | null;
  readonly last: number | null;
}

/** What each person achieved at one exercise. */
export function summaries(results: readonly Result[], exercise: string, measure: Measure): Summary[] {
  return byPerson(results.filter((result) => result.exercise === exercise)).map(([person, attempts]) => {
    const values = attempts.map(measure.of).filter((value) => value !== null);
    const good = attempts.filter(({ passed }) => passed).map(measure.of);
    const best = good.filter((value) => value !== null);
    const first = attempts.findIndex(({ passed }) => passed);
    return {
      person,
      attempts: attempts.length,
      passed: good.length,
      firstPass: first < 0 ? null : first + 1,
      best: best.length ? Math.min(...best) : null,
      last: values.at(-1) ?? null,
    };
  });
}

/** Results by person in alphabetical order; of each person the oldest first. */
function byPerson(results: readonly Result[]): [string, Result[]][] {
  const people = new Map<string, Result[]>();
  for (const result of results) people.set(result.person, [...(people.get(result.person) ?? []), result]);
  for (const attempts of people.values()) attempts.sort((a, b) => a.date.localeCompare(b.date));
  return [...people].sort(([a], [b]) => a.localeCompare(b));
}
