// node test_live.mjs FOLDER: the runs of the page against those of the core, which live_reference.py has written.
import { deepStrictEqual, ok, strictEqual, throws } from "node:assert";
import { readdirSync, readFileSync } from "node:fs";
import { load } from "./punctura.mjs";

const folder = process.argv[2];
const { LiveRun, tablesOf } = await load();
const HEAD = 40;

/** Where a frame's number columns end: before the words, which are single bytes. */
const sameFrame = (made, wanted, words, where) => {
  strictEqual(made.byteLength, wanted.byteLength, where);
  const bytes = [new Uint8Array(made), new Uint8Array(wanted)];
  deepStrictEqual(bytes[0].slice(0, HEAD), bytes[1].slice(0, HEAD), `head of ${where}`);
  const end = made.byteLength - words;
  const [a, b] = [made, wanted].map((frame) => new Float32Array(frame.slice(HEAD, end)));
  for (const [i, x] of a.entries()) ok(Object.is(x, b[i]), `number ${i} of ${where}: ${x}, not ${b[i]}`);
  deepStrictEqual(bytes[0].slice(end), bytes[1].slice(end), `words of ${where}`);
};

/** The same, but with 12 digits of each number: cos() of two C libraries may differ in the last one. */
const close = (a, b, where) => {
  if (typeof a === "number" && typeof b === "number")
    return ok(Math.abs(a - b) <= 1e-12 * Math.max(1e-3, Math.abs(a)), `${where}: ${a}, not ${b}`);
  if (typeof a !== "object" || a === null) return strictEqual(a, b, where);
  deepStrictEqual(Object.keys(a).sort(), Object.keys(b).sort(), where);
  for (const [key, value] of Object.entries(a)) close(value, b[key], `${where}.${key}`);
};

let ticks = 0;
for (const file of readdirSync(folder).filter((name) => name.endsWith(".json"))) {
  const name = file.replace(/\.json$/, "");
  const read = (ending) => readFileSync(`${folder}/${name}.${ending}`);
  const { scene, events, estimates, exchange, fault } = JSON.parse(read("json").toString());
  const bytes = read("poses");
  const poses = new Float64Array(bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.length));
  const frames = read("frames");
  const words = 3 + scene.membranes.length; // state, fault, limit, and the phase of each membrane

  const run = new LiveRun(read("toml").toString(), { number: 7 });
  const { tables: _, ...view } = scene;
  close(run.scene, view, name);
  run.arm();
  run.compare(true);
  run.estimate(true);
  const found = [];
  for (let k = 0, at = 0; at < frames.length; ++k) {
    if (k === exchange) run.exchange(read("other.toml").toString());
    const size = frames.readUInt32LE(at);
    const wanted = frames.buffer.slice(frames.byteOffset + at + 4, frames.byteOffset + at + 4 + size);
    const pose = poses.slice(6 * k, 6 * k + 6);
    const made = run.feed(k === fault ? [NaN, NaN, NaN] : pose.slice(0, 3), pose.slice(3));
    sameFrame(made, wanted, words, `${name}, tick ${k}`);
    found.push(...run.messages());
    at += 4 + size;
    ++ticks;
  }
  strictEqual(poses.length / 6, ticks % 4000 || 4000);
  const kinds = (kind) => found.filter((message) => message.kind === kind);
  deepStrictEqual(kinds("event"), events, name);
  close(kinds("estimate"), estimates, `${name}, estimates`);
  ok(kinds("laws").length > 1, "the direction of the needle changes, and the laws with it");
  run.free();
}

// The simulated hand: strokes until the next target, in blocks of any size, with the same bits.
const toml = readFileSync(`${folder}/k06-fig10.toml`, "utf8");
const one = new LiveRun(toml);
const many = new LiveRun(toml);
const told = [one, many].map((run) => {
  run.arm();
  run.strokes(4);
  ok(run.strokesNow);
  return [];
});
for (let k = 0; k < 6400; ++k) {
  one.advance(1);
  told[0].push(...one.messages());
}
for (let k = 0; k < 100; ++k) {
  many.advance(64);
  told[1].push(...many.messages());
}
const eventsOf = (messages) => messages.filter(({ kind }) => kind === "event");
deepStrictEqual(eventsOf(told[0]), eventsOf(told[1]));
deepStrictEqual(eventsOf(told[0]).map(({ what }) => what), ["touch", "pop", "out"]);
deepStrictEqual(one.advance(20), many.advance(20));
one.target([0, 3e-3, 0], [0, -2, 0]);
deepStrictEqual([one.strokesNow, one.pose], [false, { position: [0, 3e-3, 0], axis: [0, -1, 0] }]);
strictEqual(one.advance(0).byteLength, 0);

// What a scene file has, as it is written; problems in its own keys; nothing changes after them.
const pi = tablesOf('a = 1\nb = [0.1, -2e-7]\n[c]\nd = "x\\n"\n[[e]]\nf = true\n');
deepStrictEqual(pi, { a: 1, b: [0.1, -2e-7], c: { d: "x\n" }, e: [{ f: true }] });
strictEqual(tablesOf("[needle"), null);
const kept = many.advance(1).byteLength;
throws(() => many.exchange(toml.replace(/friction = [^\n]*/, "friction = -1")), /membrane\[0\]\.friction = -1: /);
strictEqual(many.advance(1).byteLength, kept);
throws(() => new LiveRun(toml.replace(/friction = [^\n]*/, "")), /membrane\[0\]\.friction: is missing/);

console.log(`${ticks} frames of ticks on a fed device have the bits of the core.`);
