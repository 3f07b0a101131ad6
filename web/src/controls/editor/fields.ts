/** Converts the JSON Schema of a scene file to the fields of a form. All texts come from the schema. */

type FieldKind = "number" | "integer" | "text" | "choice" | "vector" | "numbers";

export interface Bound {
  readonly value: number;
  /** Whether the bound itself is excluded. */
  readonly open: boolean;
}

/** One key of a table. */
export interface Field {
  readonly key: string;
  readonly title: string;
  readonly help: string;
  readonly symbol: string;
  readonly unit: string;
  readonly kind: FieldKind;
  readonly least: Bound | null;
  readonly most: Bound | null;
  /** The reason for the bounds. */
  readonly reason: string;
  readonly options: readonly (string | number)[];
  /** A word that may stand in place of the number; empty if none may. */
  readonly word: string;
  /** Each option's value in the unit of the other key of its pair: a gauge's diameter in mm. */
  readonly sizes: readonly number[];
  readonly required: boolean;
  readonly standard: unknown;
  /** The heading of the folded part of the form in which the field is; empty for the open part. */
  readonly folded: string;
}

/** One table of the file; `list` if it can be repeated. */
export interface Table {
  readonly key: string;
  readonly title: string;
  readonly help: string;
  readonly list: boolean;
  /** A scene may lack this table. */
  readonly optional: boolean;
  readonly fields: readonly Field[];
  /** The table holds exactly one key of each pair. */
  readonly pairs: readonly (readonly [string, string])[];
}

export interface SceneForm {
  readonly fields: readonly Field[];
  readonly tables: readonly Table[];
}

type Json = Readonly<Record<string, unknown>>;

export class SchemaError extends Error {}

function object(value: unknown, what: string): Json {
  if (typeof value !== "object" || value === null || Array.isArray(value))
    throw new SchemaError(`${what} is not an object`);
  return value as Json;
}
const text = (value: unknown): string => (typeof value === "string" ? value : "");
const list = (value: unknown): readonly unknown[] => (Array.isArray(value) ? value : []);

/** Throws SchemaError if the schema is not that of a scene file. */
export function sceneForm(schema: unknown): SceneForm {
  const root = object(schema, "the schema");
  const definitions = object(root.$defs ?? {}, "$defs");
  const fields: Field[] = [];
  const tables: Table[] = [];
  const required = new Set(list(root.required));
  for (const [key, raw] of Object.entries(object(root.properties, "properties"))) {
    const entry = object(raw, key);
    const isList = entry.type === "array" && "$ref" in object(entry.items ?? {}, `${key}.items`);
    const reference = text(isList ? object(entry.items, key).$ref : entry.$ref);
    if (!reference) {
      fields.push(field(key, entry, required.has(key)));
      continue;
    }
    const name = reference.replace("#/$defs/", "");
    tables.push(table(key, object(definitions[name], name), isList, entry));
  }
  return { fields, tables };
}

function table(key: string, definition: Json, isList: boolean, entry: Json): Table {
  const required = new Set(list(definition.required));
  return {
    key,
    title: text(entry.title) || text(definition.title) || key,
    help: text(definition.description),
    list: isList,
    optional: entry["x-optional"] === true,
    fields: Object.entries(object(definition.properties, key)).map(([name, raw]) =>
      field(name, object(raw, name), required.has(name)),
    ),
    pairs: list(definition.allOf).flatMap(pair),
  };
}

/** `{"oneOf": [{"required": ["a"]}, {"required": ["b"]}]}` */
function pair(rule: unknown): [string, string][] {
  const keys = list(object(rule, "allOf").oneOf).map((each) => text(list(object(each, "oneOf").required)[0]));
  return keys.length === 2 && keys[0] && keys[1] ? [[keys[0], keys[1]]] : [];
}

/** A file's unit as the page calls it. */
const unitWords = (unit: string): string => (unit === "deg" ? "degrees" : unit);

function field(key: string, whole: Json, required: boolean): Field {
  // A number or a word: {"anyOf": [{"type": "number", ...}, {"const": "automatic"}]}
  const kinds = list(whole.anyOf).map((each) => object(each, key));
  const entry = { ...whole, ...kinds.find((each) => each.type === "number") };
  const options = list(entry.enum).filter((o): o is string | number => typeof o === "string" || typeof o === "number");
  return {
    key,
    title: text(entry.title) || key,
    help: text(entry.description),
    symbol: text(entry["x-symbol"]),
    unit: unitWords(text(entry["x-unit"])),
    kind: kind(key, entry, options.length > 0),
    least: bound(entry.minimum, entry.exclusiveMinimum),
    most: bound(entry.maximum, entry.exclusiveMaximum),
    reason: text(entry["x-reason"]),
    options,
    word: text(kinds.find((each) => "const" in each)?.const),
    sizes: list(entry["x-diameters-mm"]).filter((size) => typeof size === "number"),
    required,
    standard: entry.default,
    folded: text(entry["x-folded"]),
  };
}

function kind(key: string, entry: Json, hasOptions: boolean): FieldKind {
  if (hasOptions) return "choice";
  if (entry.type === "number" || entry.type === "integer") return entry.type;
  if (entry.type === "string") return "text";
  if (entry.type === "array") return typeof entry.minItems === "number" ? "vector" : "numbers";
  throw new SchemaError(`${key} has a type that the editor does not know`);
}

function bound(closed: unknown, open: unknown): Bound | null {
  if (typeof open === "number") return { value: open, open: true };
  return typeof closed === "number" ? { value: closed, open: false } : null;
}

const GREEK: Readonly<Record<string, string>> = { kappa: "κ", mu: "μ", theta: "θ", tau: "τ", phi: "φ" };

/** A symbol in print: κ for kappa; its index, if it has one, stands below. */
export function printed(symbol: string): { readonly letter: string; readonly index: string } {
  const [letter = "", index = ""] = symbol.split("_");
  return { letter: GREEK[letter] ?? letter, index };
}
