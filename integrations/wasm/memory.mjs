// The WebAssembly module and its memory: text, numbers and structs for the functions of punctura.h.

import { STATUS } from "./structs.mjs";

const NO_PROGRAM = "WebAssembly ran out of memory, or found a defect of Punctura. Load the module again.";

/** The imports of the module that only a program with files, a clock or a console needs. */
function importsOf(module) {
  const all = {};
  for (const { module: from, name } of WebAssembly.Module.imports(module)) {
    all[from] ??= {};
    all[from][name] = () => {
      throw new Error(NO_PROGRAM);
    };
  }
  return all;
}

async function fetched(url) {
  const answer = await fetch(url);
  if (!answer.ok) throw new Error(`${url} cannot be loaded: status ${answer.status}`);
  return answer.arrayBuffer();
}

async function bytesAt(url) {
  if (url.protocol !== "file:") return fetched(url);
  const { readFile } = await import(/* webpackIgnore: true */ /* @vite-ignore */ NODE_FILES);
  return readFile(url);
}
const NODE_FILES = "node:fs/promises"; // a name that no bundler resolves

/**
 * punctura.wasm beside this file. A bundler that knows this form of URL copies the file. Where it does not, or where a
 * server answers with something else, the bytes come from a module that every bundler takes along.
 */
async function ownBytes() {
  try {
    const bytes = new Uint8Array(await bytesAt(new URL("./punctura.wasm", import.meta.url)));
    if (MAGIC.every((byte, i) => bytes[i] === byte)) return bytes;
  } catch {
    // as if the server had answered with something else
  }
  const { text } = await import("./embedded.mjs");
  return Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0));
}
const MAGIC = [0, 0x61, 0x73, 0x6d]; // the first bytes of each WebAssembly module

function bytesOf(source) {
  if (source === undefined) return ownBytes();
  if (source instanceof ArrayBuffer || ArrayBuffer.isView(source)) return source;
  if (!(source instanceof URL) && typeof source !== "string")
    throw new TypeError(`load() takes nothing, a URL, or the bytes of punctura.wasm, not ${shown(source)}`);
  const base = import.meta.url; // apart from `new URL`, of which a bundler wants to know the file
  return bytesAt(new URL(source, base));
}

/** A value of a wrong type, in a message. */
export const shown = (given) => (Array.isArray(given) ? "a list" : String(given));

/** An error with `problems`: where in the scene, the value, and the reason. */
export class PuncturaError extends Error {
  constructor(message, problems = []) {
    super(message);
    this.name = "PuncturaError";
    this.problems = problems;
  }
}

/** Memory of a fixed size that no call frees: pointers, a pose, a force. */
const SCRATCH = 256;

export class Memory {
  /** source: URL or bytes of the module. */
  static async load(source) {
    const module = await WebAssembly.compile(await bytesOf(source));
    const { exports } = await WebAssembly.instantiate(module, importsOf(module));
    exports._initialize?.();
    return new Memory(exports);
  }

  constructor(c) {
    this.c = c;
    this.scratch = c.malloc(SCRATCH);
    this.#doubles = new Float64Array(c.memory.buffer);
    this.#view = new DataView(c.memory.buffer);
  }
  #doubles;
  #view;

  // The memory may grow; then all views of it are empty.
  get doubles() {
    if (this.#doubles.length === 0) this.#doubles = new Float64Array(this.c.memory.buffer);
    return this.#doubles;
  }
  get view() {
    if (this.#view.buffer !== this.c.memory.buffer) this.#view = new DataView(this.c.memory.buffer);
    return this.#view;
  }

  text(at) {
    const bytes = new Uint8Array(this.c.memory.buffer);
    return new TextDecoder().decode(bytes.slice(at, bytes.indexOf(0, at)));
  }
  /** A copy of bytes, in an ArrayBuffer of its own. */
  bytes(at, size) {
    return this.c.memory.buffer.slice(at, at + size);
  }
  /** Calls use(address, size) with a text, which ends with a zero that size does not count. */
  withText(text, use) {
    const bytes = new TextEncoder().encode(`${text}\0`);
    return this.withMemory(bytes.length, (at) => {
      new Uint8Array(this.c.memory.buffer).set(bytes, at);
      return use(at, bytes.length - 1);
    });
  }
  withMemory(size, use) {
    const at = this.c.malloc(size);
    try {
      return use(at);
    } finally {
      this.c.free(at);
    }
  }

  /** Three numbers into the scratch memory. */
  put(three, at) {
    if (three?.length !== 3) throw new RangeError("a position, an axis or a force has three numbers");
    this.doubles.set(three, at / 8);
  }
  triple(at) {
    const k = at / 8;
    const { doubles } = this;
    return [doubles[k], doubles[k + 1], doubles[k + 2]];
  }

  /** Throws the last error of the library if the status is one. */
  must(status) {
    if (status) throw this.error(status);
  }
  error(status) {
    const { c, scratch } = this;
    // A tick keeps no text: the last error is then an older one.
    if (STATUS[status] === "no_peek" || STATUS[status] === "no_number")
      return new PuncturaError(this.text(c.punctura_status_text(status)), []);
    const problems = [];
    for (let i = 0; i < c.punctura_problem_count(); ++i) {
      this.c.punctura_problem(i, scratch, scratch + 8, scratch + 16);
      const { view } = this;
      problems.push({
        path: this.text(view.getUint32(scratch, true)),
        value: view.getFloat64(scratch + 8, true),
        reason: this.text(view.getUint32(scratch + 16, true)),
      });
    }
    const said = this.text(c.punctura_last_error());
    return new PuncturaError(said || this.text(c.punctura_status_text(status)), problems);
  }
  /** The pointer that make(address of a pointer) writes. */
  made(make) {
    this.must(make(this.scratch));
    return this.view.getUint32(this.scratch, true);
  }
}

/** An object of the library. free() gives its memory back; a later use throws. */
export class Handle {
  #at;
  #free;
  constructor(at, free) {
    this.#at = at;
    this.#free = free;
  }
  get at() {
    if (!this.#at) throw new Error("this object was freed: make a new one");
    return this.#at;
  }
  free() {
    if (this.#at) this.#free(this.#at);
    this.#at = 0;
  }
}
