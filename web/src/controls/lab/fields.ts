/** "skin: tip length" of "membrane[0].tip_length", "needle: diameter" of "needle.diameter". names: of the membranes. */
export function fieldWords(path: string, names: readonly string[]): string {
  const dot = path.indexOf(".");
  const owner = path.slice(0, dot);
  const index = /^membrane\[(\d+)\]$/.exec(owner)?.[1];
  const name = index === undefined ? undefined : `${Number(index) + 1} ${names[Number(index)] ?? "membrane"}`;
  return `${name ?? owner}: ${path.slice(dot + 1).replaceAll("_", " ")}`;
}

/** The names without what all have in front of " = ": "285 N/m" of "membrane[0].stiffness = 285 N/m". */
export function shortNames(names: readonly string[]): readonly string[] {
  const varied = names[0]?.split(" = ")[0];
  const all = names.length > 1 && names.every((name) => name.startsWith(`${varied} = `));
  return all ? names.map((name) => name.slice(`${varied} = `.length)) : names;
}
