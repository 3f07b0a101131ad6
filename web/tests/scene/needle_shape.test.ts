import { Vector3 } from "three";
import { describe, expect, it } from "vitest";
import { bevelSide, placeNeedle } from "../../src/scene/bevel.ts";
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
