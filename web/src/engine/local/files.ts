import { Api, type Fetch } from "../../wire/api.ts";
import type { Tables } from "./core.ts";
import { NEEDS_STUDIO } from "./status.ts";

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

/** The files of the static folder that stand for the server's. */
const SCHEMA = "/api/schema";
const SCENE = "/api/scene.toml";

/** The files of a page without a server: the schema of scenes, and the present scene to save. */
export class LocalFiles extends Api {
  /** tables: of the present scene. */
  constructor(
    base: string,
    private readonly tables: () => Tables | null,
  ) {
    const fetcher: Fetch = (path, init) =>
      path === SCHEMA
        ? fetch(new URL("schema.json", base), init)
        : Promise.resolve(new Response(NEEDS_STUDIO, { status: 501 }));
    super("", fetcher);
  }

  override address(path: string): string {
    if (path !== SCENE) return super.address(path);
    return `data:application/toml;charset=utf-8,${encodeURIComponent(tomlOf(this.tables() ?? {}))}`;
  }
}
