import { Vector3 } from "three";

export const AROUND = 60;
export const RINGS = 15;
/** Of the rounded square that a slab is: 2 would be a circle. */
export const CORNERS = 5;

/**
 * How much of the needle's way the tissue at a distance (mm) goes along: as the surface of a half-space under a
 * point.
 */
export const carried = (distance: number, width: number): number => (1 + (Math.max(0, distance) / width) ** 2) ** -1.5;

/** Two directions in a face: as far as possible the first to the right. */
export function tangents(normal: Vector3, t1: Vector3, t2: Vector3): void {
  const along = Math.abs(normal.x) > 0.9 ? new Vector3(0, 0, 1) : new Vector3(1, 0, 0);
  t1.copy(along).addScaledVector(normal, -normal.dot(along)).normalize();
  t2.crossVectors(normal, t1);
}

/** Triangles between the rings of two faces, then of the rim, then of the hole's wall. */
export function slabTriangles(): number[] {
  const index: number[] = [];
  const row = AROUND + 1;
  const perFace = (RINGS + 1) * row;
  const quad = (a: number, b: number, c: number, d: number): void => void index.push(a, b, c, c, b, d);
  for (let ring = 0; ring < RINGS; ring++) {
    for (let i = 0; i < AROUND; i++) {
      const a = ring * row + i;
      quad(a, a + 1, a + row, a + row + 1); // seen from in front
      quad(perFace + a, perFace + a + row, perFace + a + 1, perFace + a + row + 1);
    }
  }
  for (let wall = 0; wall < 2; wall++) {
    const start = 2 * perFace + 2 * wall * row;
    for (let i = 0; i < AROUND; i++) {
      const a = start + i;
      if (wall === 0) quad(a, a + 1, a + row, a + row + 1);
      else quad(a, a + row, a + 1, a + row + 1);
    }
  }
  return index;
}

/** Lines along the borders of both faces, and round both mouths of the hole. */
export function slabEdges(): number[] {
  const index: number[] = [];
  const row = AROUND + 1;
  const perFace = (RINGS + 1) * row;
  for (const start of [RINGS * row, perFace + RINGS * row, 0, perFace]) {
    for (let i = 0; i < AROUND; i++) index.push(start + i, start + i + 1);
  }
  return index;
}
