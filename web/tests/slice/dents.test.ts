import { Vector3 } from "three";
import { expect, it } from "vitest";
import { Moment, OUTSIDE } from "../../src/scene/moment.ts";
import { planeOf, skinFrame } from "../../src/scene/probe.ts";
import { dentsOf, displacementAt, knotsOf } from "../../src/slice/dents.ts";
import { type Tissue, tissueOf } from "../../src/slice/layers.ts";
import { veinHeight } from "../../src/slice/words.ts";
import { fakeMembranes, fakeScene } from "../support/fake_model.ts";

const SLIDING_IN = 2;
const inward = new Vector3(0, -1, 0);
const scene = fakeScene(fakeMembranes());
const skin = skinFrame(scene);
const tissue: Tissue = tissueOf(scene, skin);
const membranes = tissueOf({ ...scene, lumen: [] }, skin).layers.map(({ from, thickness, normal }) => ({
  front: -from,
  thickness,
  normal,
}));

/** The needle pushes the front wall by `lead` mm, with its proxy `depth` mm behind the wall's front. */
function pushing(lead: number, depth: number): Moment {
  const moment = new Moment();
  moment.tip.set(0, -4.81 - depth - lead, 0);
  const none = { phase: OUTSIDE, depth: 0, proxy: new Vector3(), direction: new Vector3() };
  const held = { phase: SLIDING_IN, depth, proxy: new Vector3(0, -4.81 - depth, 0), direction: inward.clone() };
  moment.membranes = [none, held, { ...none }];
  return moment;
}

it("a membrane's face is displaced by the way from its proxy to the tip", () => {
  const knots = knotsOf(pushing(0.8, 0.2), membranes, inward, 2);
  const shift = displacementAt(knots, 4.81 + 0.8, 2, new Vector3());
  expect(shift.dot(inward)).toBeCloseTo(0.8, 6);
  expect(displacementAt(knots, 30, 2, shift).length()).toBeLessThan(1e-3);
});

it("without contact nothing is displaced", () => {
  const moment = pushing(0.8, 0.2);
  moment.membranes[1]!.phase = OUTSIDE;
  const dents = dentsOf(moment, membranes, planeOf(skin, { x: 0, z: 0, turn: 0 }), 0.8, 100, 0.15);
  expect(dents.most).toBe(0);
});

it("a vein flattens while the needle pushes its wall, and is round again after the pop", () => {
  const plane = planeOf(skin, { x: 0, z: 0, turn: 0 });
  const height = (moment: Moment) => veinHeight(tissue, dentsOf(moment, membranes, plane, 0.8, 300, 0.05), 0.05);
  const round = height(pushing(0, 0.2));
  expect(round).toBeCloseTo(2 * tissue.vein!.radius, 1);
  expect(height(pushing(1.2, 0.2))).toBeLessThan(0.8 * round);
  expect(height(pushing(2.4, 0.2))).toBeLessThan(height(pushing(1.2, 0.2)));
});
