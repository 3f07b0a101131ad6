import { expect, it } from "vitest";
import type { Hand } from "../../src/hand/hand.ts";
import type { Thumb } from "../../src/hand/thumb.ts";
import { flatGrip } from "../../src/scene/flat_grip.ts";
import { Probe } from "../../src/scene/probe.ts";
import type { App } from "../../src/state/app.ts";

const lean = Math.PI / 6; // to the skin

/** The places, m, to which a drag takes a needle at 30 degrees to the skin; the slice has 0.2 mm per pixel. */
function dragged(sideways: boolean, ...drags: [dx: number, dy: number][]): number[][] {
  const places: number[][] = [];
  const hand = {
    grab: () => ({ position: [0, 0.01, 0], axis: [Math.cos(lean), -Math.sin(lean), 0] }),
    moveTo: (place: number[]) => places.push(place),
  } as unknown as Hand;
  const scene = { membranes: [{ point: [0, 0, 0], inward_normal: [0, -1, 0] }] };
  const probe = new Probe();
  probe.picture.value = { width: 80, depth: 40 };
  const app = { live: { scene: { value: scene } } } as unknown as App;
  const grip = flatGrip(app, hand, probe, {} as Thumb, () => 400);
  expect(grip.grab(100, 50, sideways)).toBe(true);
  for (const [dx, dy] of drags) grip.drag(100 + dx, 50 + dy);
  return places.slice(1);
}

it("a drag along the needle in the slice moves it along its line, by as much as the picture shows", () => {
  const [along, across] = dragged(
    false,
    [50 * Math.cos(lean), 50 * Math.sin(lean)],
    [-50 * Math.sin(lean), 50 * Math.cos(lean)],
  ) as [number[], number[]];
  expect(along).toEqual([0.01 * Math.cos(lean), 0.01 - 0.01 * Math.sin(lean), 0].map((x) => expect.closeTo(x, 9)));
  expect(across).toEqual([0, 0.01, 0].map((x) => expect.closeTo(x, 9)));
});

it("a drag to the side moves it along the skin only", () => {
  expect(dragged(true, [25, 40])).toEqual([[expect.closeTo(0.005, 9), 0.01, expect.closeTo(0, 9)]]);
});
