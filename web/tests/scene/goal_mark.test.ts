import { Color, type Mesh, Vector3 } from "three";
import { expect, test } from "vitest";
import { bandOf, GoalMark } from "../../src/scene/goal_mark.ts";
import type { Theme } from "../../src/scene/theme.ts";
import type { GoalLine, SceneView } from "../../src/wire/messages.ts";

const theme = { watch: (act: () => void) => act(), color: () => new Color("green") } as unknown as Theme;
const scene = {
  membranes: [{ point: [0, 0.001, 0], inward_normal: [0, -1, 0], thickness: 0.001 }],
} as unknown as SceneView;

test("a goal without an end is drawn 3 mm deep", () => {
  expect(bandOf({ top: 0.004, bottom: 0.007 })).toEqual([4, 7]);
  expect(bandOf({ top: 0.004, bottom: Number.POSITIVE_INFINITY })).toEqual([4, 7]);
});

test("the band lies between the goal's depths, below the first surface", () => {
  const mark = new GoalMark(theme);
  mark.show({ name: "a", top: 0.005, bottom: 0.008, line: null }, scene, 10);
  const band = mark.group.children[0] as Mesh;
  expect(mark.group.visible).toBe(true);
  expect(band.position.toArray()).toEqual([0, 1 - 6.5, 0]);
  expect(new Vector3(0, 1, 0).multiply(band.scale).applyQuaternion(band.quaternion).length()).toBeCloseTo(3);
  mark.show({ name: "a", top: 0.005, bottom: 0.012, line: null }, scene, 10, 7);
  expect(band.position.toArray()).toEqual([0, 1 - 6, 0]); // it ends with the drawn tissue
  mark.show(null, scene, 10);
  expect(mark.group.visible).toBe(false);
});

test("the mark stays in the drawn tissue, which follows the needle, and on its line", () => {
  const mark = new GoalMark(theme);
  const show = (line: GoalLine | null): void => mark.show({ name: "a", top: 0.005, bottom: 0.008, line }, scene, 10);
  show(null);
  mark.follow(new Vector3(-7, 1, 2), new Vector3(1, 0, 0));
  expect(mark.group.position.toArray()).toEqual([-7, 0, 2]);
  expect(mark.middle.toArray()).toEqual([-7, 1 - 6.5, 2]);
  show({ point: [0, -0.0055, 0.004], along: [1, 0, 0], within: 0.001 });
  expect(mark.group.position.length()).toBe(0);
  mark.follow(new Vector3(-7, 1, 2), new Vector3(1, 0, 0));
  expect(mark.group.position.toArray().map((x) => x + 0)).toEqual([-7, 0, 0]);
  expect(mark.middle.x).toBeCloseTo(-7);
  expect(mark.middle.z).toBeCloseTo(4);
});

test("in tissue that is cut open, the band lies on the cut, at its own layer, however that is turned", () => {
  const mark = new GoalMark(theme);
  mark.show({ name: "a", top: 0.005, bottom: 0.008, line: null }, scene, 10, 9);
  mark.follow(new Vector3(-4, 1, 0), new Vector3(0, 0, 1));
  const band = mark.group.children[0] as Mesh;
  const size = new Vector3(0, 0, 1).multiply(band.scale).applyQuaternion(band.quaternion);
  expect(Math.abs(size.x)).toBeLessThan(0.2);
  expect(mark.group.position.x).toBeCloseTo(-4);
});

test("the band of a line lies around the line, as wide as the point may be beside it", () => {
  const mark = new GoalMark(theme);
  const line: GoalLine = { point: [0, -0.0055, 0.004], along: [1, 0, 0], within: 0.001 };
  mark.show({ name: "a", top: 0.005, bottom: 0.008, line }, scene, 10);
  const band = mark.group.children[0] as Mesh;
  expect(band.position.x).toBeCloseTo(0);
  expect(band.position.y).toBeCloseTo(1 - 6.5);
  expect(band.position.z).toBeCloseTo(4);
  const sides = (
    [
      [1, 0, 0],
      [0, 1, 0],
      [0, 0, 1],
    ] as const
  ).map((axis) => new Vector3(...axis).multiply(band.scale).applyQuaternion(band.quaternion));
  expect(sides.map((side) => Math.abs(side.y)).filter((y) => y > 1e-6)).toEqual([expect.closeTo(3)]);
  expect(sides.map((side) => Math.abs(side.z)).filter((z) => z > 1e-6)).toEqual([expect.closeTo(2)]);
});
