import { BufferAttribute, BufferGeometry } from "three";
import { type NeedleLook, tipOffset } from "./needle_look.ts";

const AROUND = 48;
const BORE = 0.62;
const BENT_RINGS = 10; // along the curved part
/** The curved part of a Tuohy needle, in lengths of its opening. */
const BENT = 1.5;

/** A closed ribbon of `rings` rows of points round the needle, the first point of a row repeated at its end. */
function ribbon(positions: number[], normals: number[], rings: number): BufferGeometry {
  const made = new BufferGeometry();
  made.setAttribute("position", new BufferAttribute(new Float32Array(positions), 3));
  made.setAttribute("normal", new BufferAttribute(new Float32Array(normals), 3));
  const index: number[] = [];
  for (let i = 0; i < AROUND; i++) {
    for (let ring = 0; ring + 1 < rings; ring++) {
      const a = i * rings + ring;
      index.push(a, a + rings, a + 1, a + 1, a + rings, a + rings + 1);
    }
  }
  made.setIndex(index);
  return made;
}

/** How far a place `z` behind the tip is moved to the side, so that the shaft's middle is where its look wants it. */
function bend(z: number, diameter: number, tipLength: number, look: NeedleLook): number {
  const aside = (tipOffset(look) - tipOffset("hypodermic")) * diameter;
  if (aside === 0) return 0;
  const straight = Math.min(1, z / (BENT * tipLength));
  return aside * (1 - (1 - straight) ** 2);
}

/** Points round the needle: share of the radius, and the height above the slanted plane. */
function round(
  diameter: number,
  tipLength: number,
  look: NeedleLook,
  rows: readonly { part: number; up: number }[],
  normal: (c: number, s: number) => readonly [number, number, number],
  length = 0,
): BufferGeometry {
  const r = diameter / 2;
  const slope = tipLength / diameter;
  const positions: number[] = [];
  const normals: number[] = [];
  for (let i = 0; i <= AROUND; i++) {
    const c = Math.cos((2 * Math.PI * i) / AROUND);
    const s = Math.sin((2 * Math.PI * i) / AROUND);
    for (const { part, up } of rows) {
      const x = r + r * part * c;
      const z = slope * x * (1 - up) + length * up;
      positions.push(x + bend(z, diameter, tipLength, look), r * part * s, z);
      normals.push(...normal(c, s));
    }
  }
  return ribbon(positions, normals, rows.length);
}

/**
 * The shaft: a cylinder along +z, cut by a slanted plane. Its lowest point, the tip, is at 0 (K06 Fig. 1). A Tuohy
 * needle's tip is then bent until it lies on the middle line of the shaft, which turns its opening to the side.
 * Lengths in mm; tipLength: length of the bevel along the needle.
 */
export function shaftShape(
  diameter: number,
  tipLength: number,
  length: number,
  look: NeedleLook = "hypodermic",
): BufferGeometry {
  const curved = (BENT * tipLength) / length;
  const rows = [{ part: 1, up: 0 }];
  if (look === "tuohy") {
    for (let i = 1; i <= BENT_RINGS; i++) rows.push({ part: 1, up: (curved * i) / BENT_RINGS });
  }
  rows.push({ part: 1, up: 1 });
  return round(diameter, tipLength, look, rows, (c, s) => [c, s, 0], length);
}

/** The bevel: a ring round the bore, or the bore's mouth if `bore` is true. */
export function faceShape(
  diameter: number,
  tipLength: number,
  bore: boolean,
  look: NeedleLook = "hypodermic",
): BufferGeometry {
  const slope = tipLength / diameter;
  const size = Math.hypot(slope, 1);
  const [inner, outer] = bore ? [0, BORE] : [BORE, 1];
  const rows = [
    { part: inner, up: 0 },
    { part: outer, up: 0 },
  ];
  return round(diameter, tipLength, look, rows, () => [slope / size, 0, -1 / size]);
}
