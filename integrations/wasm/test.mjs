// node test.mjs FOLDER: all forces of the reference motion, bit for bit, the messages, size and time of a tick.
import { deepStrictEqual, strictEqual, throws } from "node:assert";
import { readFileSync, statSync } from "node:fs";
import { load } from "./punctura.mjs";

const folder = process.argv[2];
const numbers = (name) => {
  const bytes = readFileSync(`${folder}/${name}`);
  return new Float64Array(bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.length));
};
const scene = readFileSync(`${folder}/scene.txt`, "utf8");
const { Insertion, Proxy1d } = await load();
const motion = numbers("motion.f64");
const depths = numbers("depths.f64");
const ticks = depths.length / 2;
const rows = Array.from({ length: ticks }, (_, k) => motion.slice(9 * k, 9 * k + 9));
const poses = rows.map((row) => [row.slice(0, 3), row.slice(3, 6)]);

const insertion = new Insertion(scene);
for (const [k, row] of rows.entries()) deepStrictEqual(insertion.step(...poses[k]), [...row.slice(6)], `tick ${k}`);
const proxy = new Proxy1d(scene, 0);
for (let k = 0; k < ticks; ++k) strictEqual(proxy.step(depths[2 * k]), depths[2 * k + 1], `tick ${k}`);

for (const depth of [NaN, Infinity, -Infinity, 1e9]) throws(() => proxy.step(depth), /depth is .*finite/);
throws(() => insertion.step([NaN, 0, 0], [0, -1, 0]), /position is \[NaN,0,0\]/);
throws(() => insertion.step([0, 1e9, 0], [0, -1, 0]), /position is/);
throws(() => insertion.step([0, 0, 0], [0, 0, 0]), /axis not 0/);
throws(() => insertion.step([0, 0], [0, -1, 0]), /three numbers/);
insertion.reset();
deepStrictEqual(insertion.step(...poses[0]), [...rows[0].slice(6)], "after errors and reset");
const part = { needle: { diameter: 1e-3, tip_angle: 0.3 }, coupling: { stiffness: 400, damping: 1 } };
throws(() => new Insertion({ ...part, membrane: [] }), /^Error: membrane = 0: there must be at least one membrane/);
throws(() => new Insertion({ ...part, membrane: [{ friction: -1 }] }), /membrane\[0\]\.friction = -1: /);
throws(() => new Insertion({ ...part, needle: { width: 1 } }), /no number "needle\.width"/);
throws(() => new Insertion("needle.diameter 3"), /line 1 of the scene must be PATH = NUMBER/);
throws(() => new Proxy1d(scene, 9), /membrane 9: the scene has/);
proxy.free();
throws(() => proxy.step(0), /was freed/);

const best = (go) => {
  let shortest = Infinity;
  for (let round = 0; round < 20; ++round) {
    const start = performance.now();
    go();
    shortest = Math.min(shortest, performance.now() - start);
  }
  return ((1e6 * shortest) / ticks).toFixed(0);
};
const line = new Proxy1d(scene, 0);
const places = depths.filter((_, i) => i % 2 === 0);
const onLine = best(() => places.forEach((depth) => line.step(depth)));
const inSpace = best(() => poses.forEach(([position, axis]) => insertion.step(position, axis)));
const { size } = statSync(new URL("punctura.wasm", import.meta.url));
console.log(`${2 * ticks} forces have the bits of the core. punctura.wasm: ${size} bytes`);
console.log(`Node ${process.version}: Proxy1d.step ${onLine} ns, Insertion.step ${inSpace} ns`);
