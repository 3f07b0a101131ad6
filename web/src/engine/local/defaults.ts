type Json = Readonly<Record<string, unknown>>;
type Tables = Record<string, unknown>;

/**
 * The tables of a scene file with the defaults of the schema filled in, as the editor shows them. The studio's server
 * does the same. An optional table that is missing stays missing.
 */
export function withDefaults(tables: Json, schema: Json): Tables {
  const definitions = (schema.$defs ?? {}) as Readonly<Record<string, Json>>;
  const resolved = (part: Json): Json => {
    const name = typeof part.$ref === "string" ? part.$ref.split("/").at(-1)! : null;
    return name ? { ...definitions[name], ...part } : part;
  };
  /** A table without required keys may be left out; it then has its defaults. */
  const standard = ({ default: value, properties, required }: Json): unknown =>
    value ?? (properties && !(required as readonly string[] | undefined)?.length ? {} : undefined);
  const filled = (value: unknown, given: Json): unknown => {
    const part = resolved(given);
    if (Array.isArray(value)) return part.items ? value.map((each) => filled(each, part.items as Json)) : value;
    if (typeof value !== "object" || value === null || !part.properties) return value;
    const table: Tables = {};
    for (const [key, property] of Object.entries(part.properties as Readonly<Record<string, Json>>)) {
      const own = (value as Json)[key] ?? standard(resolved(property));
      if (own !== undefined) table[key] = filled(own, property);
    }
    return { ...table, ...Object.fromEntries(Object.entries(value).filter(([key]) => !(key in table))) };
  };
  return filled(tables, schema) as Tables;
}
