import { Matrix4, Vector3 } from "three";

/** Where the slanted face looks: as far to the right as the needle allows. A stylus without roll has no other. */
export function bevelSide(axis: Vector3, side = new Vector3()): Vector3 {
  const along = Math.abs(axis.x) > 0.95 ? new Vector3(0, 1, 0) : new Vector3(1, 0, 0);
  return side.copy(along).addScaledVector(axis, -axis.dot(along)).normalize();
}

/** Places what is built with the tip at 0, the shaft along +z and the slanted face towards +x. */
export function placeNeedle(tip: Vector3, axis: Vector3, matrix = new Matrix4()): Matrix4 {
  const x = bevelSide(axis);
  const z = axis.clone().negate();
  return matrix.makeBasis(x, new Vector3().crossVectors(z, x), z).setPosition(tip);
}
