import { MeshBasicMaterial, Vector3 } from "three";
import { describe, expect, it } from "vitest";
import { Slab, untouched } from "../../src/scene/slab.ts";
import { AROUND, displacement, slabEdges, slabTriangles } from "../../src/scene/slab_shape.ts";

const DOWN = new Vector3(0, -1, 0);
const ORIGIN = new Vector3();

function points(slab: Slab): Vector3[] {
  const all = slab.mesh.geometry.getAttribute("position");
  return Array.from({ length: all.count }, (_, i) => new Vector3().fromBufferAttribute(all, i));
}

describe("a slab", () => {
  it("is flat, and as thick as its membrane, while nothing touches it", () => {
    const slab = new Slab(new MeshBasicMaterial());
    slab.update(ORIGIN, DOWN, 4, 10, [untouched(), untouched()], 2, DOWN);
    const heights = new Set(points(slab).map(({ y }) => Math.round(y * 1e4) / 1e4 + 0));
    expect([...heights].sort()).toEqual([-4, 0]);
    for (const { x, z } of points(slab)) expect(Math.max(Math.abs(x), Math.abs(z))).toBeLessThanOrEqual(10 + 1e-5);
  });

  it("gives way fully at the needle, not at all at its border, and smoothly between", () => {
    const slab = new Slab(new MeshBasicMaterial());
    const front = { ...untouched(), hole: 0.5, shift: new Vector3(0, -1.5, 0) };
    slab.update(ORIGIN, DOWN, 1, 10, [front, untouched()], 2, DOWN);
    const face = points(slab).slice(0, points(slab).length / 2);
    const at = (r: number): number[] => face.filter((p) => Math.abs(Math.hypot(p.x, p.z) - r) < 1e-4).map(({ y }) => y);
    expect(Math.min(...at(0.5))).toBeCloseTo(-1.5, 5);
    expect(Math.min(...face.map(({ y }) => y))).toBeCloseTo(-1.5, 5);
    expect(at(10).every((y) => Math.abs(y) < 1e-5)).toBe(true);
    expect([displacement(0, 2), displacement(2, 2), displacement(100, 2)]).toEqual([
      1,
      expect.closeTo(0.3536, 3),
      expect.closeTo(0, 4),
    ]);
  });

  it("has a hole of the needle's width across the needle, also where that comes at a slant", () => {
    const slab = new Slab(new MeshBasicMaterial());
    const slant = new Vector3(Math.sin(1), -Math.cos(1), 0);
    const front = { ...untouched(), hole: 0.5 };
    slab.update(ORIGIN, DOWN, 1, 10, [front, untouched()], 2, slant);
    for (const p of points(slab).slice(0, AROUND + 1)) {
      const across = p.clone().addScaledVector(slant, -p.dot(slant));
      expect(across.length()).toBeCloseTo(0.5, 4);
    }
  });

  it("is laid anew only when something differs", () => {
    const slab = new Slab(new MeshBasicMaterial());
    const faces = [untouched(), untouched()] as const;
    expect(slab.update(ORIGIN, DOWN, 1, 10, faces, 2, DOWN)).toBe(true);
    expect(slab.update(ORIGIN, DOWN, 1, 10, faces, 2, DOWN)).toBe(false);
    faces[0].shift.y = -0.1;
    expect(slab.update(ORIGIN, DOWN, 1, 10, faces, 2, DOWN)).toBe(true);
  });

  it("has no triangle and no edge beyond its points", () => {
    const slab = new Slab(new MeshBasicMaterial());
    const count = slab.mesh.geometry.getAttribute("position").count;
    expect(Math.max(...slabTriangles())).toBeLessThan(count);
    expect(Math.max(...slabEdges())).toBeLessThan(count);
  });
});
