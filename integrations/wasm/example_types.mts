// Compiled by test.sh, not run: the types of punctura.d.mts fit what they describe.
import { load, type MembraneTick, type PuncturaError, type Scene } from "./punctura.mjs";

const { Insertion, LiveRun, Proxy1d, Servo, tablesOf, version } = await load(new Uint8Array());
const scene: Scene = {
  needle: { diameter: 1.08e-3, tip_angle: 0.28 },
  coupling: { stiffness: 400, damping: 1 },
  membrane: [
    { stiffness: 570, precompression: 0.41, friction: 0.2, thickness: 1e-3, point: [0, 0, 0], inward_normal: [0, -1, 0] },
  ],
};
const insertion = new Insertion(scene);
const [x, y, z]: [number, number, number] = insertion.step([0, -1e-3, 0], new Float64Array([0, -1, 0]));
insertion.peek([0, 0, 0], [0, -1, 0]);
insertion.commit();
const kept: Uint8Array = insertion.state;
insertion.state = kept;
const { phase }: MembraneTick = insertion.membrane(0);
const force: number = new Proxy1d({ lines: "" }, 0).step(x + y + z);
const servo = new Servo("[needle]", { max_force: 3 });
const record = servo.step({ sequence: 0, time: 0, position: [0, 0, 0], axis: [0, -1, 0] });
const run = new LiveRun(scene, { pose: { position: [0, 0, 0], axis: [0, -1, 0] } });
const next = new LiveRun(scene, { after: run });
for (const message of next.messages()) if (message.kind === "event") message.force_before.toFixed(3);
const frame: ArrayBuffer = next.advance(13);
const problems = (error: PuncturaError): string[] => error.problems.map(({ path, reason }) => path + reason);
console.log(phase, force, record.force[1], frame.byteLength, LiveRun.about.limits.max_force, tablesOf(""), version, problems);

// @ts-expect-error a scene needs a needle
new Insertion({ coupling: { stiffness: 400, damping: 1 }, membrane: [] });
// @ts-expect-error a position has a number for each axis
insertion.step("0 0 0", [0, -1, 0]);
