/** "skin: tip length" of "membrane[0].tip_length", "needle: diameter" of "needle.diameter". names: of the membranes. */
export function fieldWords(path: string, names: readonly string[]): string {
  const dot = path.indexOf(".");
  const owner = path.slice(0, dot);
  const index = /^membrane\[(\d+)\]$/.exec(owner)?.[1];
  const name = index === undefined ? undefined : `${Number(index) + 1} ${names[Number(index)] ?? "membrane"}`;
  const key = path.slice(dot + 1).replace(/\[(\d)\]$/, (_, axis) => ` ${"xyz"[Number(axis)]}`);
  return `${name ?? owner}: ${key.replaceAll("_", " ")}`;
}

/** The editor's units, by those of the core, and the size of one SI unit in them. */
const UNITS: Readonly<Record<string, readonly [unit: string, gain: number]>> = {
  m: ["mm", 1e3],
  "1/m": ["1/mm", 1e-3],
  "N/m": ["N/mm", 1e-3],
  "N s/m": ["N s/mm", 1e-3],
  rad: ["degrees", 180 / Math.PI],
  "-": ["", 1],
};

/** The unit in which the editor shows a field with this SI unit, and the size of one SI unit in it. */
export const shownUnit = (si: string): readonly [unit: string, gain: number] => UNITS[si] ?? [si, 1];

/** A number as a person writes it. */
export const plainNumber = (value: number, digits = 6): string => String(Number(value.toPrecision(digits)));

/** "1 skin: stiffness = 0.285 N/mm" of "membrane[0].stiffness = 285 N/m"; other names of runs as they are. */
export function runWords(run: string, names: readonly string[]): string {
  const [, path, value, si = ""] = /^([a-z]\w*(?:\[\d+\])?\.[\w.[\]]+) = (\S+)(?: (.+))?$/.exec(run) ?? [];
  if (path === undefined || !Number.isFinite(Number(value))) return run;
  const [unit, gain] = shownUnit(si);
  return `${fieldWords(path, names)} = ${plainNumber(Number(value) * gain)} ${unit}`.trim();
}

/** The names without what all have in front of " = ": "0.285 N/mm" of "1 skin: stiffness = 0.285 N/mm". */
export function shortNames(names: readonly string[]): readonly string[] {
  const varied = names[0]?.split(" = ")[0];
  const all = names.length > 1 && names.every((name) => name.startsWith(`${varied} = `));
  return all ? names.map((name) => name.slice(`${varied} = `.length)) : names;
}
