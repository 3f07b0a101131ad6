// node test.mjs FOLDER: all forces of the reference motion, bit for bit, the messages, and the size.
import { deepStrictEqual, match, rejects, strictEqual, throws } from "node:assert";
import { readFileSync, statSync } from "node:fs";
import { load } from "./punctura.mjs";

const folder = process.argv[2];
const numbers = (name) => {
  const bytes = readFileSync(`${folder}/${name}`);
  return new Float64Array(bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.length));
};
const scene = { lines: readFileSync(`${folder}/scene.txt`, "utf8") };
const file = readFileSync(`${folder}/scene.toml`, "utf8");
const { Insertion, Proxy1d, Servo } = await load();
const motion = numbers("motion.f64");
const depths = numbers("depths.f64");
const ticks = depths.length / 2;
const rows = Array.from({ length: ticks }, (_, k) => motion.slice(9 * k, 9 * k + 9));
const poses = rows.map((row) => [row.slice(0, 3), row.slice(3, 6)]);

const insertion = new Insertion(scene);
for (const [k, row] of rows.entries()) deepStrictEqual(insertion.step(...poses[k]), [...row.slice(6)], `tick ${k}`);
const fromFile = new Insertion(file);
const kept = [];
for (const [k, row] of rows.entries()) {
  if (k === 1500) kept.push(fromFile.state);
  fromFile.peek([0, -5e-3, 0], [0, -1, 0]); // the next peek replaces it
  deepStrictEqual(fromFile.peek(...poses[k]), [...row.slice(6)], `peek, tick ${k}`);
  fromFile.commit();
}
throws(() => new Insertion("name = 1"), /needle/);
throws(() => fromFile.commit(), /no tick to commit/); // not the older error
fromFile.state = kept[0];
for (let k = 1500; k < 1600; ++k) deepStrictEqual(fromFile.step(...poses[k]), [...rows[k].slice(6)], `again, tick ${k}`);
const { phase, depth: inside, lower, upper, axialForce } = fromFile.membrane(0);
strictEqual(phase === "outside" ? 0 : 1, inside > 0 ? 1 : 0);
strictEqual(axialForce >= lower && axialForce <= upper, true);
throws(() => fromFile.membrane(9), RangeError);
kept[0][20] ^= 1;
throws(() => (fromFile.state = kept[0]), /damaged/);

// The servo step gives what the model gives, once its ramp is over, below its limits.
const servo = new Servo(file, { max_force: 20, continuous_force: 20, ramp_time: 0.01, axis_tolerance: 0.1 });
servo.arm();
const sampleOf = (k) => ({ sequence: k, time: k / 1600, position: poses[k][0], axis: poses[k][1] });
for (const [k, row] of rows.entries()) {
  const peeked = servo.peek(sampleOf(k));
  const record = servo.step(sampleOf(k));
  deepStrictEqual(record, peeked);
  deepStrictEqual(record.modelForce, [...row.slice(6)], `servo, tick ${k}`);
  if (k > 100) deepStrictEqual(record.force, record.modelForce, `servo, tick ${k}`);
  strictEqual(record.tick, k);
}
const faulted = servo.step({ sequence: ticks, time: ticks / 1600, position: [NaN, 0, 0], axis: [0, -1, 0] });
deepStrictEqual([faulted.state, faulted.force], ["faulted", [0, 0, 0]]);
match(faulted.fault, /not finite/);
throws(() => new Servo(file, { max_farce: 1 }), /no limit max_farce/);
throws(() => new Servo(file, { max_force: -1 }), /max_force = -1: /);

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
throws(() => new Insertion({ ...part, membrane: [] }), /^PuncturaError: membrane = 0: there must be at least one/);
throws(() => new Insertion({ ...part, membrane: [{ friction: -1 }] }), /membrane\[0\]\.friction = -1: /);
throws(() => new Insertion({ ...part, needle: { width: 1 } }), /no number "needle\.width"/);
throws(() => new Insertion({ lines: "needle.diameter 3" }), /line 1: /);
throws(() => new Insertion({ ...part, membrane: [{ friction: true }] }), /membrane\[0\]\.friction must be a number, or/);
throws(() => new Insertion("[needle"), /line 1, column .*not TOML/);
for (const given of [null, undefined, 5, [scene]])
  throws(() => new Insertion(given), /^TypeError: a scene is the text of .*, not (null|undefined|5|a list)$/);
throws(() => new Insertion({ lines: 5 }), /^TypeError: lines is a text .*, not 5$/);
throws(() => new Servo(file, null), /^TypeError: limits is an object.*, not null$/);
throws(() => servo.step(null), /^TypeError: a sample is .*, not null$/);
throws(() => servo.step({ ...sampleOf(0), sequence: 1.5 }), /^TypeError: sequence is 1.5: /);
throws(() => insertion.step(null, [0, -1, 0]), /three numbers/);
throws(() => (fromFile.state = null), /^TypeError: a state is a Uint8Array, not null$/);
for (const given of [null, 5]) await rejects(load(given), /^TypeError: load\(\) takes nothing, a URL, .*, not (null|5)$/);
const wrong = file.replace(/friction = [^\n]*/, "friction = -1").replace(/thickness_mm = [^\n]*/, "thickness_mm = -1");
throws(
  () => new Insertion(wrong),
  ({ problems }) => problems.map(({ path }) => path).join() === "membrane[0].friction,membrane[0].thickness_mm",
);
throws(() => new Proxy1d(scene, 9), /membrane 9: the scene has/);
proxy.free();
throws(() => proxy.step(0), /was freed/);

const { size } = statSync(new URL("punctura.wasm", import.meta.url));
console.log(`${2 * ticks} forces have the bits of the core. punctura.wasm: ${size} bytes`);
