import type { History } from "../state/history.ts";
import { LIMITS } from "../state/limits.ts";
import { isCompared } from "./gather.ts";

const ROWS_A_PART = 4096;
const STATES = ["disarmed", "waiting", "active", "faulted"];

/** A name that fits into a column's: letters, digits and underscores. */
export function columnName(name: string): string {
  return (
    name
      .trim()
      .toLowerCase()
      .replace(/[^\p{L}\p{N}]+/gu, "_")
      .replace(/^_+|_+$/g, "") || "membrane"
  );
}

/** Names of the membranes for columns, each another. */
export function columnNames(names: readonly string[], count: number): string[] {
  const taken = new Map<string, number>();
  return Array.from({ length: count }, (_, i) => {
    const name = columnName(names[i] ?? `membrane ${i + 1}`);
    const times = (taken.get(name) ?? 0) + 1;
    taken.set(name, times);
    return times === 1 ? name : `${name}_${times}`;
  });
}

/** The fewest digits that give the same f32 again; empty for what does not exist. */
export function exactF32(value: number): string {
  if (!Number.isFinite(value)) return Number.isNaN(value) ? "" : String(value);
  for (let digits = 6; digits < 9; digits++) {
    const text = value.toPrecision(digits);
    if (Math.fround(Number(text)) === value) return String(Number(text));
  }
  return String(Number(value.toPrecision(9)));
}

/**
 * Every tick from `first` to before `end`, SI, a line each: of one membrane or (null) of all. Parts of a file.
 * Forces of membranes are along the needle's direction b, negative where they push the needle out.
 */
export function csv(
  history: History,
  first: number,
  end: number,
  names: readonly string[],
  membrane: number | null,
): string[] {
  const m = history.membranes;
  const wanted = columnNames(names, m)
    .map((name, i) => ({ name, i }))
    .filter(({ i }) => membrane === null || i === membrane);
  const vector = (name: string, unit: string): string[] => ["x", "y", "z"].map((axis) => `${name}_${axis}_${unit}`);
  const compared = isCompared(history, first, end);
  const head = [
    "tick", "time_s", "state", "limit", ...vector("position", "m"), ...vector("force", "N"), ...vector("model_force", "N"),
    ...(compared ? vector("other_solver_force", "N") : []),
    ...wanted.flatMap(({ name }) => [
      `depth_${name}_m`, `axial_force_${name}_N`, `lower_${name}_N`, `upper_${name}_N`, `phase_${name}`,
    ]),
  ]; // biome-ignore format: a table
  const parts = [`${head.join(",")}\n`];
  const triples = [history.column("position"), history.column("force"), history.column("model_force")];
  if (compared) triples.push(history.column("other_force"));
  const cells = [
    history.column("depth"),
    history.column("axial_force"),
    history.column("lower"),
    history.column("upper"),
  ];
  const state = history.byteColumn("state");
  const limit = history.byteColumn("limit");
  const phase = history.byteColumn("phase");
  let rows: string[] = [];
  for (let tick = first; tick < end; tick++) {
    const slot = history.slot(tick);
    const row = [
      String(tick),
      history.timeOf(tick).toFixed(9),
      STATES[state[slot]!] ?? String(state[slot]),
      LIMITS[limit[slot]!] ?? "",
    ];
    for (const triple of triples) for (let k = 0; k < 3; k++) row.push(exactF32(triple[3 * slot + k]!));
    for (const { i } of wanted) {
      for (const cell of cells) row.push(exactF32(cell[slot * m + i]!));
      row.push(String(phase[slot * m + i]!));
    }
    rows.push(row.join(","));
    if (rows.length === ROWS_A_PART || tick === end - 1) {
      parts.push(`${rows.join("\n")}\n`);
      rows = [];
    }
  }
  return parts;
}
