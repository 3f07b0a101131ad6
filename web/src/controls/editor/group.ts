import { element } from "../../panel.ts";
import type { Draft } from "./draft.ts";
import type { Input } from "./field_frame.ts";
import type { Table } from "./fields.ts";
import { pairField } from "./pair_field.ts";
import { single } from "./single.ts";
import { getAt, type Path, parsePath, pathText, type Tables } from "./tables.ts";

/** The form's fields by their path in the file, as `membrane[1].friction`. */
export type Inputs = Map<string, Input>;

/** The fields of one table at `path`, in the schema's order. */
export function group(
  table: Pick<Table, "fields" | "pairs">,
  path: Path,
  draft: Draft,
  skip: readonly string[] = [],
): { root: HTMLElement; inputs: Inputs } {
  const root = element("div", { class: "group" });
  const inputs: Inputs = new Map();
  const byKey = new Map(table.fields.map((field) => [field.key, field]));
  const paired = new Set<string>(skip);
  for (const field of table.fields) {
    if (paired.has(field.key)) continue;
    const other = byKey.get(partnerOf(table, field.key) ?? "");
    const here = [...path, field.key];
    const input = other ? pairField(field, other, path, draft) : single(field, here, draft);
    place(root, field.folded).append(input.root);
    inputs.set(pathText(here), input);
    if (other) {
      paired.add(other.key);
      inputs.set(pathText([...path, other.key]), input);
    }
  }
  return { root, inputs };
}

/** The open part of the form, or its folded part with this heading. */
function place(root: HTMLElement, heading: string): HTMLElement {
  if (!heading) return root;
  for (const part of root.querySelectorAll<HTMLElement>(":scope > details"))
    if (part.dataset.heading === heading) return part;
  const part = element("details", { class: "folded", "data-heading": heading }, element("summary", {}, heading));
  root.append(part);
  return part;
}

const partnerOf = (table: Pick<Table, "pairs">, key: string): string | undefined =>
  table.pairs.find((pair) => pair[0] === key)?.[1];

export function showAll(inputs: Inputs, tables: Tables): void {
  for (const [path, input] of inputs) input.show(getAt(tables, parsePath(path)));
}
