/** A scene file's tables as immutable values. Every edit returns a new value, so undo is a list of values. */

export type Value = unknown;
export type Tables = Readonly<Record<string, unknown>>;
export type Path = readonly (string | number)[];

/** `membrane[1].friction` as ["membrane", 1, "friction"]. */
export function parsePath(path: string): Path {
  return [...path.matchAll(/[^.[\]]+/g)].map(([part]) => (/^\d+$/.test(part) ? Number(part) : part));
}

export function pathText(path: Path): string {
  return path
    .map((part) => (typeof part === "number" ? `[${part}]` : `.${part}`))
    .join("")
    .replace(/^\./, "");
}

export function getAt(whole: Value, path: Path): Value {
  let here = whole;
  for (const part of path) {
    if (typeof here !== "object" || here === null) return undefined;
    here = (here as Record<string | number, unknown>)[part];
  }
  return here;
}

/** A copy of `whole` with `value` at `path`. Missing tables on the path are created; `undefined` removes the key. */
export function setAt<T extends Value>(whole: T, path: Path, value: Value): T {
  const [part, ...rest] = path;
  if (part === undefined) return value as T;
  if (typeof part === "number") {
    const items = Array.isArray(whole) ? [...whole] : [];
    items[part] = setAt(items[part], rest, value);
    return items as T;
  }
  const table = { ...((whole ?? {}) as Record<string, unknown>) };
  const inner = rest.length ? setAt(table[part], rest, value) : value;
  if (inner === undefined) delete table[part];
  else table[part] = inner;
  return table as T;
}

/** Replaces `key` by another key at the same place, as one key of a pair by the other. The order of keys stays. */
export function replaceKey(table: Tables, key: string, other: string, value: Value): Tables {
  const entries = Object.entries(table).map(([name, old]) => (name === key ? [other, value] : [name, old]));
  return Object.fromEntries(entries) as Tables;
}

export const membranes = (tables: Tables): readonly Tables[] =>
  Array.isArray(tables.membrane) ? (tables.membrane as Tables[]) : [];

export function withMembranes(tables: Tables, all: readonly Tables[]): Tables {
  return { ...tables, membrane: all };
}

export function moved<T>(items: readonly T[], from: number, to: number): T[] {
  const rest = items.filter((_, i) => i !== from);
  const taken = items[from];
  if (taken !== undefined) rest.splice(Math.min(Math.max(to, 0), rest.length), 0, taken);
  return rest;
}

/** Inserts a copy after the membrane at `at`, with a new name, and placed behind it along its normal. */
export function duplicated(items: readonly Tables[], at: number): Tables[] {
  const original = items[at];
  if (!original) return [...items];
  const names = new Set(items.map((each) => each.name));
  const copy = { ...original, name: freeName(String(original.name ?? "membrane"), names), point_mm: behind(original) };
  return [...items.slice(0, at + 1), copy, ...items.slice(at + 1)];
}

const GAP_MM = 2; // between a membrane and its copy

function behind(membrane: Tables): unknown {
  const { point_mm: point, inward_normal: normal, thickness_mm: thickness } = membrane;
  if (!isVector(point) || !isVector(normal)) return point;
  const length = Math.hypot(...normal);
  if (!(length > 0)) return point;
  const step = (typeof thickness === "number" ? thickness : 0) + GAP_MM;
  return point.map((x, i) => Number((x + (step * normal[i]!) / length).toFixed(6)) + 0);
}

const isVector = (value: unknown): value is number[] =>
  Array.isArray(value) && value.length === 3 && value.every((x) => typeof x === "number");

/** `name`, or the first of `name 2`, `name 3`, ... that is not taken. */
export function freeName(name: string, taken: ReadonlySet<unknown>): string {
  const stem = name.replace(/ \d+$/, "");
  if (!taken.has(name)) return name;
  for (let n = 2; ; n++) if (!taken.has(`${stem} ${n}`)) return `${stem} ${n}`;
}

/** Whether two values are equal; the order of keys does not matter. */
export function same(a: Value, b: Value): boolean {
  if (Object.is(a, b)) return true;
  if (typeof a !== "object" || typeof b !== "object" || !a || !b || Array.isArray(a) !== Array.isArray(b)) return false;
  const left = Object.entries(a);
  const right = b as Record<string, unknown>;
  return (
    left.length === Object.keys(right).length && left.every(([key, value]) => key in right && same(value, right[key]))
  );
}
