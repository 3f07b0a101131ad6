import { degrees } from "../../format.ts";
import type { ProblemPart } from "../../wire/messages.ts";
import type { Bound, Field } from "./fields.ts";
import { numberText } from "./number.ts";

/** Problems by the field that caused them. `others` are shown at the top, because no field on the page shows them. */
export interface Sorted {
  readonly fields: ReadonlyMap<string, string>;
  readonly others: readonly string[];
}

/** shown: paths of the fields on the page, as `membrane[1].friction`. */
export function sortProblems(problems: readonly ProblemPart[], shown: ReadonlySet<string>): Sorted {
  const fields = new Map<string, string>();
  const others: string[] = [];
  for (const problem of problems) {
    const path = shown.has(problem.path) ? problem.path : vectorOf(problem.path, shown);
    if (path === null) others.push(sentence(problem));
    else fields.set(path, fields.has(path) ? `${fields.get(path)} ${words(problem.reason)}` : words(problem.reason));
  }
  return { fields, others };
}

/** The problem of a vector's component, `point_mm[1]`, is shown at the vector. */
function vectorOf(path: string, shown: ReadonlySet<string>): string | null {
  const whole = path.replace(/\[\d+\]$/, "");
  return whole !== path && shown.has(whole) ? whole : null;
}

/** A problem as a sentence, with its path and value. */
export const sentence = ({ path, value, reason }: ProblemPart): string =>
  path ? `${plainPaths(path)}${value && value !== "MISSING" ? ` = ${value}` : ""}: ${words(reason)}` : words(reason);

const SCENE_PATH = /\b(needle|coupling|servo|display|syringe|membrane)(?:\[(\d+)\])?\.(\w+)(?:\[(\d)\])?/g;
const UNIT = /_(?:N|Ns|mm|rad|deg|hz|s|mL|kPa|per)(?:_\w+)?$/;

/** A text without a scene file's own names: "membrane 1, stiffness" for "membrane[0].stiffness_N_per_mm". */
export const plainPaths = (text: string): string =>
  text.replace(SCENE_PATH, (_, table: string, index: string | undefined, key: string, axis: string | undefined) => {
    const owner = index === undefined ? table : `${table} ${Number(index) + 1}`;
    const name = key.replace(UNIT, "").replaceAll("_", " ");
    return `${owner}, ${name}${axis === undefined ? "" : ` ${"xyz"[Number(axis)] ?? ""}`}`;
  });

/** A reason as a sentence in the page's words, without the number of the paper's equation. */
export function words(reason: string): string {
  const plain = plainPaths(reason.replace(/, K06 \(\d+\)$/, "")).replace(/(-?[\d.]+) deg\b/g, (_, number: string) =>
    degrees(Number(number)),
  );
  const capital = plain.charAt(0).toUpperCase() + plain.slice(1);
  return /[.!?]$/.test(capital) ? capital : `${capital}.`;
}

/** The bound of the schema that a number breaks, as a sentence; null if it breaks none. Checked before sending. */
export function boundProblem(field: Field, value: number): string | null {
  const broken = (bound: Bound | null, sign: 1 | -1): boolean =>
    bound !== null && (sign * value < sign * bound.value || (bound.open && value === bound.value));
  if (!broken(field.least, 1) && !broken(field.most, -1)) return null;
  return words(field.reason || boundText(field));
}

/** The bounds as text, as `more than 0, at most 90`; empty without bounds. */
export function boundText(field: Field): string {
  const { least, most } = field;
  const low = least && `${least.open ? "more than" : "at least"} ${numberText(Number(least.value.toPrecision(4)))}`;
  const high = most && `${most.open ? "less than" : "at most"} ${numberText(Number(most.value.toPrecision(4)))}`;
  return [low, high].filter(Boolean).join(", ");
}
