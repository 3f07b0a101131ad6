import type { History } from "../state/history.ts";
import { FIELDS } from "../wire/tick_table.ts";
import { isCompared } from "./gather.ts";

const ROWS_PER_CHUNK = 4096;

/** The shortest decimal text that reads back as the same f32; empty for NaN. */
export function exactF32(value: number): string {
  if (!Number.isFinite(value)) return Number.isNaN(value) ? "" : String(value);
  for (let digits = 6; digits < 9; digits++) {
    const text = value.toPrecision(digits);
    if (Math.fround(Number(text)) === value) return String(Number(text));
  }
  return String(Number(value.toPrecision(9)));
}

/** A column of the file: its header, and the text of its cell for a tick. */
interface Column {
  readonly head: string;
  cell(tick: number, slot: number): string;
}

/**
 * One line per tick from `first` up to but not including `end`, with the column names and units of `punctura export`,
 * for one membrane or for all (null). Numbers have the digits of f32. Returns the file in chunks.
 */
export function csv(history: History, first: number, end: number, membrane: number | null): string[] {
  const columns = columnsOf(history, first, end, membrane);
  const parts = [`${columns.map(({ head }) => head).join(",")}\n`];
  for (let from = first; from < end; from += ROWS_PER_CHUNK) {
    const rows: string[] = [];
    for (let tick = from; tick < Math.min(end, from + ROWS_PER_CHUNK); tick++) {
      const slot = history.slot(tick);
      rows.push(columns.map((column) => column.cell(tick, slot)).join(","));
    }
    parts.push(`${rows.join("\n")}\n`);
  }
  return parts;
}

function columnsOf(history: History, first: number, end: number, membrane: number | null): Column[] {
  const membranes = Array.from({ length: history.membranes }, (_, i) => i).filter(
    (i) => membrane === null || i === membrane,
  );
  const columns: Column[] = [{ head: "tick", cell: (tick) => String(tick) }];
  const each = FIELDS.filter((field) => field.perMembrane);
  for (const field of FIELDS) {
    if (!field.perMembrane) columns.push(...fieldColumns(history, field, 0));
    else if (field === each[0])
      for (const i of membranes) for (const one of each) columns.push(...fieldColumns(history, one, i));
  }
  if (isCompared({ history, first, end }))
    columns.push(...numbers(history.column("other_force"), "other_f{a}_N", 3, 3, 0));
  return columns;
}

function fieldColumns(history: History, field: (typeof FIELDS)[number], membrane: number): Column[] {
  const head = field.column.replace("{i}", String(membrane));
  if (field.name === "time") return [{ head, cell: (tick) => history.timeOf(tick).toFixed(9) }];
  const stride = field.width * (field.perMembrane ? history.membranes : 1);
  if (field.words === null)
    return numbers(history.column(field.name), head, field.width, stride, field.width * membrane);
  const codes = history.byteColumn(field.name);
  const words: readonly string[] = field.words;
  return [{ head, cell: (_, slot) => words[codes[stride * slot + membrane]!] ?? "" }];
}

/** The columns of a number, or of a vector's three components, at `offset` in each row of `stride` numbers. */
function numbers(values: Float32Array, head: string, width: number, stride: number, offset: number): Column[] {
  return Array.from({ length: width }, (_, k) => ({
    head: head.replace("{a}", "xyz"[k]!),
    cell: (_tick: number, slot: number) => exactF32(values[stride * slot + offset + k]!),
  }));
}
