import { Vector3 } from "three";
import { expect, it } from "vitest";
import { Moment, OUTSIDE } from "../../src/scene/moment.ts";
import { skinFrame } from "../../src/scene/probe.ts";
import { Denter, type Dents, displaced } from "../../src/slice/dents.ts";
import { tissueOf } from "../../src/slice/layers.ts";
import { lumenHeight } from "../../src/slice/slice.ts";
import { plainScene } from "../support/plain_scene.ts";

const SLIDING_IN = 2;
const down = new Vector3(0, -1, 0);
const scene = plainScene;
const skin = skinFrame(scene);
const tissue = tissueOf(scene, skin);
const dents = (moment: Moment): Dents => new Denter(skin, tissue, 15, 0.8).at(moment);

/** The needle pushes the front wall by `lead` mm, with its proxy `depth` mm behind the wall's front. */
function pushing(lead: number, depth: number): Moment {
  const moment = new Moment();
  moment.tip.set(0, -4.81 - depth - lead, 0);
  const none = { phase: OUTSIDE, depth: 0, proxy: new Vector3(), direction: new Vector3() };
  const held = { phase: SLIDING_IN, depth, proxy: new Vector3(0, -4.81 - depth, 0), direction: down.clone() };
  moment.membranes = [none, held, { ...none }];
  return moment;
}

it("the wall's tissue at the proxy is where the tip is", () => {
  expect(displaced(4.81 + 0.2, dents(pushing(0.8, 0.2)))).toBeCloseTo(4.81 + 0.2 + 0.8, 1);
});

it("without contact nothing is displaced", () => {
  const moment = pushing(0.8, 0.2);
  moment.membranes[1]!.phase = OUTSIDE;
  expect(dents(moment).most).toBe(0);
});

it("a vein flattens while the needle pushes its wall", () => {
  const height = (lead: number): number => lumenHeight(tissue, dents(pushing(lead, 0.2)));
  expect(height(0)).toBeCloseTo(2 * tissue.vessel!.radius, 1);
  expect(height(1.2)).toBeLessThan(0.8 * height(0));
  expect(height(2.4)).toBeLessThan(height(1.2));
});

it("a vein lies beneath the fat that the scene gives, and its walls are not layers", () => {
  expect(tissue.vessel!.depth).toBeCloseTo((4.81 + 0.4 + 8.22) / 2, 6);
  expect(tissue.layers.some(({ fill }) => fill === "blood")).toBe(false);
});
