import { MathUtils, Matrix4, Vector3 } from "three";
import type { Spot } from "../tissue/field.ts";
import { follow } from "../tissue/grid.ts";
import { tangents } from "./slab_shape.ts";

/** Tilts of the needle (sine) between which the cut turns to follow it. */
const UPRIGHT = Math.sin(MathUtils.degToRad(14));
const TILTED = Math.sin(MathUtils.degToRad(28));
/** What is drawn behind the cut, as a share of half its width. */
export const DEEP = 0.8;
/** How far entry and tip may leave the middle before the drawn part follows, as shares of half its width. */
const FREE_ENTRY = 0.45;
const FREE_TIP = 0.75;

/**
 * The plane in which the tissue is cut open: it contains the needle, so that one sees the tip inside. A point of the
 * block has the coordinates u (along the cut), d (down) and w (towards the viewer), mm.
 */
export class Cut {
  readonly origin = new Vector3();
  readonly along = new Vector3(1, 0, 0);
  readonly down = new Vector3(0, -1, 0);
  readonly towards = new Vector3(0, 0, 1);
  readonly matrix = new Matrix4();
  /** Where the plane is along `towards`, and the middle of the drawn part along `along`. */
  w = 0;
  centre = 0;
  private readonly right = new Vector3(1, 0, 0);
  private side = 1;
  /** Where the needle entered, or would enter, at first: the middle of the drawn part; null before that. */
  private first: number | null = null;

  /** origin: a point of the surface, mm; down: the inward normal, of length 1. */
  build(origin: Vector3, down: Vector3): void {
    this.origin.copy(origin);
    this.down.copy(down);
    tangents(down, this.right, new Vector3());
    this.side = 1;
    this.first = null;
  }

  /** The middle of the drawn part along `along`, before the needle has moved. */
  get middle(): number {
    return this.first ?? 0;
  }

  /** size: half the width of the drawn part. viewer: position of the camera. */
  place(tip: Vector3, axis: Vector3, viewer: Vector3, size: number): void {
    const { down, along, towards, right } = this;
    const tilt = new Vector3().copy(axis).addScaledVector(down, -axis.dot(down));
    const turn = MathUtils.smoothstep(tilt.length(), UPRIGHT, TILTED);
    along.copy(right);
    if (turn > 0) {
      tilt.normalize();
      if (tilt.dot(right) < 0) tilt.negate();
      along
        .multiplyScalar(1 - turn)
        .addScaledVector(tilt, turn)
        .normalize();
    }
    towards.crossVectors(down, along);
    // The half that hides the cut is left out. A camera that looks along the cut changes nothing.
    const seen = viewer.clone().sub(tip).normalize().dot(towards);
    if (Math.abs(seen) > 0.06) this.side = Math.sign(seen);
    towards.multiplyScalar(this.side);
    const inside = tip.clone().sub(this.origin);
    const depth = Math.max(0, inside.dot(down));
    const steep = Math.max(0.2, Math.abs(axis.dot(down)));
    const entry = inside.clone().addScaledVector(axis, -depth / steep);
    // Behind the whole needle, also where it is slightly tilted out of the plane.
    this.w = Math.min(inside.dot(towards), entry.dot(towards));
    // It follows a needle that leaves its middle, and then a tip that is far along the cut.
    const enters = inside
      .clone()
      .addScaledVector(axis, -inside.dot(down) / steep)
      .dot(along);
    this.first ??= enters;
    const entered = this.first + follow(enters - this.first, FREE_ENTRY * size);
    this.centre = entered + (depth > 0 ? follow(inside.dot(along) - entered, FREE_TIP * size) : 0);
    this.matrix.makeBasis(along, down, towards).setPosition(this.origin);
  }

  /** The coordinates of a place in the block. */
  spot(place: Vector3): Spot {
    const from = place.clone().sub(this.origin);
    return { u: from.dot(this.along), d: from.dot(this.down) };
  }

  /** The place of a point of the block. */
  point(u: number, d: number, w: number): Vector3 {
    return new Vector3(u, d, w).applyMatrix4(this.matrix);
  }
}
