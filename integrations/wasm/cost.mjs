// node cost.mjs REFERENCE: the time of a tick in WebAssembly, in ns, as integrations/cost.py reads it.
import { readFileSync } from "node:fs";
import { load } from "./punctura.mjs";

const folder = process.argv[2];
const numbers = (name) => {
  const bytes = readFileSync(`${folder}/${name}`);
  return new Float64Array(bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.length));
};
const toml = readFileSync(`${folder}/scene.toml`, "utf8");
const { Insertion, LiveRun, Proxy1d } = await load();
const depths = numbers("depths.f64").filter((_, i) => i % 2 === 0);
const motion = numbers("motion.f64");
const poses = Array.from(depths, (_, k) => [motion.slice(9 * k, 9 * k + 3), motion.slice(9 * k + 3, 9 * k + 6)]);

const best = (go) => {
  let shortest = Infinity;
  for (let round = 0; round < 20; ++round) {
    const start = performance.now();
    go();
    shortest = Math.min(shortest, performance.now() - start);
  }
  return ((1e6 * shortest) / depths.length).toFixed(1);
};
const line = new Proxy1d(toml, 0);
const insertion = new Insertion(toml);
const live = new LiveRun(toml);
live.arm();
live.strokes(2);
const BLOCK = 13; // ticks: 8 ms at 1600 Hz, as in the page
const tell = (name, go) => console.log(`${name}\t${best(go)}`);
tell("JavaScript: Proxy1d.step", () => depths.forEach((depth) => line.step(depth)));
tell("JavaScript: Insertion.step", () => poses.forEach(([position, axis]) => insertion.step(position, axis)));
tell("JavaScript: LiveRun.advance, device and hand included, blocks of 13", () => {
  for (let k = 0; k < depths.length; k += BLOCK) live.advance(Math.min(BLOCK, depths.length - k));
});
