import { Matrix4, Vector3 } from "three";

/** The direction that the bevel faces: as far to the right as possible. A stylus without roll does not define one. */
export function bevelSide(axis: Vector3, side = new Vector3()): Vector3 {
  const along = Math.abs(axis.x) > 0.95 ? new Vector3(0, 1, 0) : new Vector3(1, 0, 0);
  return side.copy(along).addScaledVector(axis, -axis.dot(along)).normalize();
}

/** The matrix that places a needle built with the tip at 0, the shaft along +z and the bevel towards +x. */
export function placeNeedle(tip: Vector3, axis: Vector3, matrix = new Matrix4()): Matrix4 {
  const x = bevelSide(axis);
  const z = axis.clone().negate();
  return matrix.makeBasis(x, new Vector3().crossVectors(z, x), z).setPosition(tip);
}
