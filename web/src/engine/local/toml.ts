/** The text of a scene file with these tables: numbers, words, lists of them, tables, and lists of tables. */
export function tomlOf(tables: Readonly<Record<string, unknown>>): string {
  const lines: string[] = [];
  const later: string[] = [];
  for (const [key, value] of Object.entries(tables)) {
    if (isTables(value)) for (const each of value) later.push("", `[[${keyText(key)}]]`, ...valueLines(each));
    else if (isTable(value)) later.push("", `[${keyText(key)}]`, ...valueLines(value));
    else lines.push(`${keyText(key)} = ${valueText(value)}`);
  }
  return `${[...lines, ...later].join("\n")}\n`;
}

type Table = Readonly<Record<string, unknown>>;

const isTable = (value: unknown): value is Table =>
  typeof value === "object" && value !== null && !Array.isArray(value);
const isTables = (value: unknown): value is readonly Table[] =>
  Array.isArray(value) && value.length > 0 && value.every(isTable);

const valueLines = (table: Table): string[] =>
  Object.entries(table).map(([key, value]) => `${keyText(key)} = ${valueText(value)}`);

const keyText = (key: string): string => (/^[\w-]+$/.test(key) ? key : JSON.stringify(key));

function valueText(value: unknown): string {
  if (typeof value === "number")
    return Number.isFinite(value) ? String(value) : value > 0 ? "inf" : value < 0 ? "-inf" : "nan";
  if (typeof value === "boolean") return String(value);
  if (typeof value === "string") return wordText(value);
  if (Array.isArray(value)) return `[${value.map(valueText).join(", ")}]`;
  if (isTable(value)) return `{ ${valueLines(value).join(", ")} }`;
  return '""'; // null and undefined: the reader says what is wrong with a word there
}

/** JSON's escapes are TOML's; TOML also escapes the character 127. */
const wordText = (word: string): string => JSON.stringify(word).replaceAll("\u007f", "\\u007f");
