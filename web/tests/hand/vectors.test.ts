import { describe, expect, it } from "vitest";
import type { Triple } from "../../src/engine/engine.ts";
import { alongSkin, dot, length, tilted, tiltOf } from "../../src/hand/vectors.ts";

const NORMALS: readonly Triple[] = [
  [0, -1, 0],
  [1, 0, 0],
  [0, 0, 1],
  [0.6, -0.8, 0],
  [0.36, -0.8, 0.48],
];

describe.each(NORMALS)("a needle to the skin whose inward normal is (%d, %d, %d)", (...normal) => {
  it("leans in the plane of the normal and of a direction along the skin", () => {
    expect(dot(alongSkin(normal), normal)).toBeCloseTo(0, 12);
    expect(length(alongSkin(normal))).toBeCloseTo(1, 12);
  });

  it.each([-1.2, -0.3, 0, 0.5, 1.3])("by %d rad, as it was told", (angle) => {
    const axis = tilted(angle, normal);
    expect(length(axis)).toBeCloseTo(1, 12);
    expect(dot(axis, normal)).toBeCloseTo(Math.cos(angle), 12);
    expect(tiltOf(axis, normal)).toBeCloseTo(angle, 12);
  });
});
