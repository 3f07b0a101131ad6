import { BufferAttribute, BufferGeometry } from "three";

const AROUND = 48;
const BORE = 0.62;

/** Two triangles from each pair of points to the next, once round. */
const INDEX = Array.from({ length: AROUND }, (_, i) => [0, 2, 1, 1, 2, 3].map((k) => 2 * i + k)).flat();

/** A closed ribbon of AROUND pairs of points, with the first pair repeated at the end. */
function ribbon(positions: number[], normals: number[]): BufferGeometry {
  const made = new BufferGeometry();
  made.setAttribute("position", new BufferAttribute(new Float32Array(positions), 3));
  made.setAttribute("normal", new BufferAttribute(new Float32Array(normals), 3));
  made.setIndex(INDEX);
  return made;
}

/**
 * The shaft: a cylinder along +z, cut by a slanted plane. Its lowest point, the tip, is at 0 (K06 Fig. 1).
 * Lengths in mm; tipLength: length of the bevel along the needle.
 */
export function shaftShape(diameter: number, tipLength: number, length: number): BufferGeometry {
  const r = diameter / 2;
  const slope = tipLength / diameter;
  const positions: number[] = [];
  const normals: number[] = [];
  for (let i = 0; i <= AROUND; i++) {
    const c = Math.cos((2 * Math.PI * i) / AROUND);
    const s = Math.sin((2 * Math.PI * i) / AROUND);
    const x = r + r * c;
    positions.push(x, r * s, slope * x, x, r * s, length);
    normals.push(c, s, 0, c, s, 0);
  }
  return ribbon(positions, normals);
}

/** The bevel: a ring round the bore, or the bore's mouth if `bore` is true. */
export function faceShape(diameter: number, tipLength: number, bore: boolean): BufferGeometry {
  const r = diameter / 2;
  const slope = tipLength / diameter;
  const size = Math.hypot(slope, 1);
  const normal = [slope / size, 0, -1 / size] as const;
  const [inner, outer] = bore ? [0, BORE] : [BORE, 1];
  const positions: number[] = [];
  const normals: number[] = [];
  for (let i = 0; i <= AROUND; i++) {
    const c = Math.cos((2 * Math.PI * i) / AROUND);
    const s = Math.sin((2 * Math.PI * i) / AROUND);
    for (const part of [inner, outer]) {
      const x = r + r * part * c;
      positions.push(x, r * part * s, slope * x);
      normals.push(...normal);
    }
  }
  return ribbon(positions, normals);
}
