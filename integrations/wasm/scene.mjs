// Scenes from the text of a scene file, or from an object with the names and SI units of the C library.
import { shown } from "./memory.mjs";

/** Numbers and words of a nested object as lines: `membrane[0].friction = 0.2`. */
function* linesOf(object, path = "") {
  for (const [key, value] of Object.entries(object)) {
    const at = Array.isArray(object) ? `${path}[${key}]` : path ? `${path}.${key}` : key;
    if (typeof value === "object" && value !== null) yield* linesOf(value, at);
    else if (typeof value === "number") yield `${at} = ${value}`;
    else if (typeof value === "string" && !/[\r\n]/.test(value)) yield `${at} = "${value}"`;
    else throw new Error(`${at} must be a number, or a word in one line, not ${value}`);
  }
}

/** Calls use(scene) with a scene of the library, which exists until then. given: Scene, see punctura.d.mts. */
export function withScene(memory, given, use) {
  const { c } = memory;
  const fromToml = typeof given === "string";
  if (!fromToml && (typeof given !== "object" || given === null || Array.isArray(given)))
    throw new TypeError(`a scene is the text of a scene file, an object in SI units, or { lines }, not ${shown(given)}`);
  if (!fromToml && "lines" in given && typeof given.lines !== "string")
    throw new TypeError(`lines is a text with lines "path = value", not ${shown(given.lines)}`);
  const text = fromToml ? given : "lines" in given ? given.lines : [...linesOf(given)].join("\n");
  const read = fromToml ? c.punctura_scene_from_toml : c.punctura_scene_from_values;
  const scene = memory.withText(text, (at, size) => memory.made((to) => read(at, size, to)));
  try {
    return use(scene);
  } finally {
    c.punctura_scene_free(scene);
  }
}
