import { Color, Group, Mesh, MeshLambertMaterial, type Vector3 } from "three";
import { placeNeedle } from "./bevel.ts";
import { Hub } from "./hub.ts";
import { faceShape, shaftShape } from "./needle_shape.ts";
import { steel } from "./steel.ts";
import type { Theme } from "./theme.ts";

const EMPTY = new Color(0x23272d);

/** The needle of the scene: its true diameter and tip angle; its length is the view's choice. mm, rad. */
export class Needle {
  readonly group = new Group();
  private hub: Hub | null = null;
  private readonly steel = steel(0.92);
  private readonly ground = steel(1.15);
  private readonly bore = new MeshLambertMaterial();

  constructor(private readonly theme: Theme) {
    this.group.matrixAutoUpdate = false;
  }

  build(diameter: number, tipAngle: number, length: number): void {
    for (const child of this.group.children) if (child instanceof Mesh) child.geometry.dispose();
    this.group.clear();
    this.hub = new Hub(diameter, this.theme);
    this.hub.group.position.set(diameter / 2, 0, length);
    this.group.add(
      new Mesh(shaftShape(diameter, tipAngle, length), this.steel),
      new Mesh(faceShape(diameter, tipAngle, false), this.ground),
      new Mesh(faceShape(diameter, tipAngle, true), this.bore),
      this.hub.group,
    );
  }

  place(tip: Vector3, axis: Vector3): void {
    placeNeedle(tip, axis, this.group.matrix);
    this.group.matrixWorldNeedsUpdate = true;
  }

  /** Blood at the bore's mouth and in the hub; true where the picture changes. */
  step(inLumen: boolean, elapsedMs: number): boolean {
    this.bore.color.copy(inLumen ? this.theme.color("blood") : EMPTY);
    return this.hub?.step(inLumen, elapsedMs) ?? false;
  }
}
