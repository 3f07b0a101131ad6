import { Vector3 } from "three";

export const AROUND = 60;
export const RINGS = 15;
/** Exponent of the superellipse that outlines a slab: 2 would be a circle. */
export const CORNERS = 5;

/** Displacement of the tissue at a distance (mm) from the needle, as a share: a half-space under a point load. */
export const displacement = (distance: number, width: number): number =>
  (1 + (Math.max(0, distance) / width) ** 2) ** -1.5;

/** Computes two directions that span a face. The first points to the right as far as possible. */
export function tangents(normal: Vector3, t1: Vector3, t2: Vector3): void {
  const along = Math.abs(normal.x) > 0.9 ? new Vector3(0, 0, 1) : new Vector3(1, 0, 0);
  t1.copy(along).addScaledVector(normal, -normal.dot(along)).normalize();
  t2.crossVectors(normal, t1);
}

/** The triangles of both faces, then of the rim, then of the hole's wall. */
export function slabTriangles(): number[] {
  const index: number[] = [];
  const row = AROUND + 1;
  const perFace = (RINGS + 1) * row;
  const quad = (a: number, b: number, c: number, d: number): void => void index.push(a, b, c, c, b, d);
  for (let ring = 0; ring < RINGS; ring++) {
    for (let i = 0; i < AROUND; i++) {
      const a = ring * row + i;
      quad(a, a + 1, a + row, a + row + 1); // faces the front
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

/** Lines along the borders of both faces, and round both ends of the hole. */
export function slabEdges(): number[] {
  const index: number[] = [];
  const row = AROUND + 1;
  const perFace = (RINGS + 1) * row;
  for (const start of [RINGS * row, perFace + RINGS * row, 0, perFace]) {
    for (let i = 0; i < AROUND; i++) index.push(start + i, start + i + 1);
  }
  return index;
}
