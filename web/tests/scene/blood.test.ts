import { Vector3 } from "three";
import { expect, it } from "vitest";
import { Blood } from "../../src/scene/blood.ts";
import { BARRED, Moment, OUTSIDE } from "../../src/scene/moment.ts";
import type { Theme } from "../../src/scene/theme.ts";
import { FakeMembrane } from "../support/fake_model.ts";

const SLIDING_IN = 2;
const front = new FakeMembrane("front", 0, 0.4e-3, 450, 0.25, 0.08);
const back = new FakeMembrane("back", 3e-3, 0.4e-3, 450, 0.25, 0.08);

it.each([
  [SLIDING_IN, 0.39, OUTSIDE, false],
  [SLIDING_IN, 0.41, OUTSIDE, true],
  [SLIDING_IN, 3.5, SLIDING_IN, false],
  [OUTSIDE, 0.41, OUTSIDE, false],
  [BARRED, 0.41, OUTSIDE, false],
])("with phases %d at %d mm and %d, blood reaches the needle: %s", (phase, depth, behind, expected) => {
  const blood = new Blood({ watch: () => undefined } as unknown as Theme);
  const moment = new Moment();
  const other = { proxy: new Vector3(), direction: new Vector3(0, -1, 0) };
  moment.membranes = [
    { phase: behind, depth: 0.5, ...other },
    { phase, depth, ...other },
  ];
  const laws = [back.law(), front.law()];
  expect(blood.holdsTip(moment, laws)).toBe(false); // no lumen yet
  blood.build([1, 0]);
  expect(blood.holdsTip(moment, laws)).toBe(expected);
  expect(blood.holdsTip(moment, [])).toBe(false); // nor a law
});
