import { Vector3 } from "three";
import { describe, expect, it } from "vitest";
import { bevelSide, placeNeedle } from "../../src/scene/bevel.ts";
import { gaugeOf } from "../../src/scene/needle_gauge.ts";
import { faceShape, shaftShape } from "../../src/scene/needle_shape.ts";

describe("the needle", () => {
  it("ends in its tip, and its slanted face makes the tip angle with the shaft", () => {
    const shape = faceShape(1.08, 3.7558120442572873, false).getAttribute("position");
    const outer = Array.from({ length: shape.count }, (_, i) => new Vector3().fromBufferAttribute(shape, i));
    const lowest = outer.reduce((a, b) => (b.z < a.z ? b : a));
    expect(lowest.length()).toBeLessThan(1e-6);
    const highest = outer.reduce((a, b) => (b.z > a.z ? b : a));
    expect(Math.atan2(highest.x, highest.z)).toBeCloseTo(0.28, 6);
  });

  it("is as thick as its diameter", () => {
    const shaft = shaftShape(1.08, 3.7558120442572873, 20);
    shaft.computeBoundingBox();
    const size = shaft.boundingBox!.getSize(new Vector3());
    expect([size.x, size.y, size.z]).toEqual([expect.closeTo(1.08, 5), expect.closeTo(1.08, 5), expect.closeTo(20, 5)]);
  });

  it.each([
    [0, -1, 0],
    [0.5, -0.8, 0.2],
    [1, 0, 0],
    [0, 0, -1],
  ])("stands with its tip at the tip and its shaft behind it, pointing to (%d, %d, %d)", (x, y, z) => {
    const axis = new Vector3(x, y, z).normalize();
    const tip = new Vector3(3, -2, 1);
    const matrix = placeNeedle(tip, axis);
    expect(matrix.determinant()).toBeCloseTo(1, 9);
    expect(new Vector3().applyMatrix4(matrix).distanceTo(tip)).toBeLessThan(1e-9);
    const behind = new Vector3(0, 0, 10).applyMatrix4(matrix).sub(tip);
    expect(behind.dot(axis)).toBeCloseTo(-10, 9);
    expect(bevelSide(axis).dot(axis)).toBeCloseTo(0, 9);
  });
});

describe("a Tuohy needle", () => {
  const diameter = 1.4;
  const tipLength = 3.85;
  const points = (shape: ReturnType<typeof shaftShape>): Vector3[] => {
    const at = shape.getAttribute("position");
    return Array.from({ length: at.count }, (_, i) => new Vector3().fromBufferAttribute(at, i));
  };
  const shaft = points(shaftShape(diameter, tipLength, 60, "tuohy"));

  it("has its tip on the middle line of its shaft", () => {
    const lowest = shaft.reduce((a, b) => (b.z < a.z ? b : a));
    expect(lowest.length()).toBeLessThan(1e-6);
    const straight = shaft.filter(({ z }) => z > 20);
    const middle = straight.reduce((sum, { x }) => sum + x, 0) / straight.length;
    expect(middle).toBeCloseTo(0, 1);
    expect(Math.max(...straight.map(({ x }) => x))).toBeCloseTo(diameter / 2, 3);
  });

  it("is curved: its back lies farther from the middle above the tip than at the tip", () => {
    const back = (from: number, to: number): number =>
      Math.min(...shaft.filter(({ z }) => z >= from && z < to).map(({ x }) => x));
    expect(back(0, 0.1)).toBeGreaterThan(-0.1);
    expect(back(1.5, 3)).toBeLessThan(-0.3 * diameter);
  });

  it("has its opening to the side: it is steeper than that of a straight needle", () => {
    const face = points(faceShape(diameter, tipLength, false, "tuohy"));
    const top = face.reduce((a, b) => (b.z > a.z ? b : a));
    expect(top.z).toBeCloseTo(tipLength, 5);
    expect(top.x).toBeLessThan(0.6 * diameter);
  });
});

it.each([
  [1.08, 19, "cream"],
  [0.8, 21, "deep green"],
  [1.4, 17, "red violet"],
])("a needle of %d mm is %d G, and its hub is %s", (diameter, gauge, color) => {
  expect(gaugeOf(diameter)).toMatchObject({ gauge, color });
});

it("a needle between two gauges has none", () => {
  expect(gaugeOf(0.85)).toBeNull();
});
