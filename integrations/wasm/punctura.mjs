// Punctura in WebAssembly. SI units. Types and comments for users: punctura.d.mts. The C functions: punctura.h.

const RESULT = 0; // bytes in the scratch memory: a pointer that a function returns, then position, axis and force
const POSITION = 8;
const AXIS = 32;
const FORCE = 56;
const SCRATCH = 80;
const SETUP = 56; // sizeof punctura_setup and punctura_membrane in wasm32
const MEMBRANE = 88;
const NO_NUMBER = 5; // PUNCTURA_NO_NUMBER
const STOP = "WebAssembly ran out of memory, or found a defect of Punctura. Load the module again.";

/** The imports of the module that only a program with files, a clock or a console needs. */
const importsOf = (module) => {
  const all = {};
  for (const { module: from, name } of WebAssembly.Module.imports(module)) {
    all[from] ??= {};
    all[from][name] = () => {
      throw new Error(STOP);
    };
  }
  return all;
};

const bytesOf = async (source) => {
  if (source !== undefined && !(source instanceof URL) && typeof source !== "string") return source;
  const url = new URL(source ?? "./punctura.wasm", import.meta.url);
  if (url.protocol !== "file:") return (await fetch(url)).arrayBuffer();
  const { readFile } = await import("node:fs/promises");
  return readFile(url);
};

/** Numbers and words of a nested object, by their path: "membrane[0].friction". */
function* valuesOf(object, path) {
  for (const [key, value] of Object.entries(object)) {
    const at = Array.isArray(object) ? `${path}[${key}]` : path ? `${path}.${key}` : key;
    if (typeof value === "object" && value !== null) yield* valuesOf(value, at);
    else yield [at, value];
  }
}

/** The same from lines PATH = NUMBER and PATH = "WORD". */
function* linesOf(text) {
  for (const [i, line] of text.split("\n").entries()) {
    if (/^\s*(#|$)/.test(line)) continue;
    const found = /^\s*(\S+)\s*=\s*(?:"(.*)"|(\S+))\s*$/.exec(line);
    const number = Number(found?.[3]);
    if (!found || (found[2] === undefined && Number.isNaN(number) && found[3] !== "nan"))
      throw new Error(`line ${i + 1} of the scene must be PATH = NUMBER or PATH = "WORD": ${line.trim()}`);
    yield [found[1], found[2] ?? number];
  }
}

export async function load(source) {
  const module = await WebAssembly.compile(await bytesOf(source));
  const { exports: c } = await WebAssembly.instantiate(module, importsOf(module));
  c._initialize?.();
  const scratch = c.malloc(SCRATCH);
  let cached = new Float64Array(c.memory.buffer);
  const doubles = () => (cached.length ? cached : (cached = new Float64Array(c.memory.buffer))); // memory may grow
  const view = () => new DataView(c.memory.buffer);
  const read = (at) => {
    const bytes = new Uint8Array(c.memory.buffer);
    return new TextDecoder().decode(bytes.slice(at, bytes.indexOf(0, at)));
  };
  const withText = (text, use) => {
    const bytes = new TextEncoder().encode(`${text}\0`);
    const at = c.malloc(bytes.length);
    new Uint8Array(c.memory.buffer).set(bytes, at);
    const result = use(at);
    c.free(at);
    return result;
  };
  const must = (status) => {
    if (status) throw new Error(read(c.punctura_last_error()) || read(c.punctura_status_text(status)));
  };
  const made = (make) => {
    must(make(scratch + RESULT));
    return view().getUint32(scratch + RESULT, true);
  };
  const withStruct = (size, init, use) => {
    const at = c.malloc(size);
    must(init(at, size));
    const result = use(at);
    c.free(at);
    return result;
  };

  /** Makes the membranes, the rows of lists and the syringe of a path. */
  const grow = (scene, counts, path) => {
    const membrane = Number(/^membrane\[(\d+)\]/.exec(path)?.[1] ?? -1);
    if (membrane > 63) throw new Error(`${path}: there may be 64 membranes at most`);
    for (; counts.membranes <= membrane; ++counts.membranes)
      withStruct(MEMBRANE, c.punctura_membrane_init, (at) => must(c.punctura_scene_add_membrane(scene, at)));
    if (path.startsWith("syringe.") && !counts.syringe) {
      must(c.punctura_scene_add_syringe(scene));
      counts.syringe = true;
    }
    const row = /^(.*(?:relaxation|grip_table|profile))\[(\d+)\]/.exec(path);
    if (row) withText(row[1], (at) => must(c.punctura_scene_make_rows(scene, at, Number(row[2]) + 1)));
  };

  const sceneOf = (given) => {
    const values = [...(typeof given === "string" ? linesOf(given) : valuesOf(given, ""))];
    const scene = withStruct(SETUP, c.punctura_setup_init, (at) => made((to) => c.punctura_scene_new(at, to)));
    const counts = { membranes: 0, syringe: false };
    try {
      for (const [path] of values) grow(scene, counts, path);
      for (const [path, value] of values)
        withText(path, (at) => {
          if (typeof value === "number") must(c.punctura_scene_set(scene, at, value));
          else if (typeof value === "string")
            withText(value, (word) => must(c.punctura_scene_set_word(scene, at, word)));
          else throw new Error(`${path} must be a number or a word, not ${value}`);
        });
    } catch (error) {
      c.punctura_scene_free(scene);
      throw error;
    }
    return scene;
  };

  /** One object of the C library. `kind`: insertion or proxy1d. */
  class Stepper {
    #at;
    #free;
    constructor(kind, scene, ...choice) {
      const description = sceneOf(scene);
      try {
        this.#at = made((to) => c[`punctura_${kind}_new`](description, ...choice, to));
      } finally {
        c.punctura_scene_free(description);
      }
      this.#free = c[`punctura_${kind}_free`];
    }
    get handle() {
      if (!this.#at) throw new Error("this object was freed: make a new one");
      return this.#at;
    }
    free() {
      if (this.#at) this.#free(this.#at);
      this.#at = 0;
    }
  }

  class Proxy1d extends Stepper {
    constructor(scene, membrane = 0) {
      super("proxy1d", scene, membrane);
    }
    step(depth) {
      const force = c.punctura_proxy1d_step(this.handle, depth);
      if (Number.isNaN(force))
        throw new RangeError(`depth is ${depth}: it must be a finite number of metres, below 1e6`);
      return force;
    }
    reset() {
      must(c.punctura_proxy1d_reset(this.handle));
    }
  }

  class Insertion extends Stepper {
    constructor(scene) {
      super("insertion", scene);
    }
    step(position, axis) {
      if (position.length !== 3 || axis.length !== 3) throw new RangeError("position and axis must have three numbers");
      const memory = doubles();
      memory.set(position, (scratch + POSITION) / 8);
      memory.set(axis, (scratch + AXIS) / 8);
      const status = c.punctura_insertion_step(this.handle, scratch + POSITION, scratch + AXIS, scratch + FORCE);
      if (status === NO_NUMBER)
        throw new RangeError(
          `position is [${position}] and axis is [${axis}]: they must be finite, a position below 1e6 m, an axis not 0`,
        );
      must(status);
      const at = (scratch + FORCE) / 8;
      return [memory[at], memory[at + 1], memory[at + 2]];
    }
    reset() {
      must(c.punctura_insertion_reset(this.handle));
    }
  }

  return { version: read(c.punctura_version()), Insertion, Proxy1d };
}
