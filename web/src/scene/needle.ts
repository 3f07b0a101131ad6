import { Color, Group, Mesh, MeshLambertMaterial, type Vector3 } from "three";
import { placeNeedle } from "./bevel.ts";
import { Hub } from "./hub.ts";
import { faceShape, shaftShape } from "./needle_shape.ts";
import { steel } from "./steel.ts";
import type { Theme } from "./theme.ts";

const EMPTY = new Color(0x23272d);

/** The scene's needle with its true diameter and tip angle. The view chooses the length. mm, rad. */
export class Needle {
  readonly group = new Group();
  private readonly mouth = new MeshLambertMaterial();
  private readonly shaft = new Mesh(undefined, steel(0.92));
  private readonly face = new Mesh(undefined, steel(1.15));
  private readonly bore = new Mesh(undefined, this.mouth);
  private readonly hub: Hub;

  constructor(private readonly theme: Theme) {
    this.hub = new Hub(theme);
    this.group.matrixAutoUpdate = false;
    this.group.add(this.shaft, this.face, this.bore, this.hub.group);
  }

  build(diameter: number, tipLength: number, length: number): void {
    for (const { geometry } of [this.shaft, this.face, this.bore]) geometry.dispose();
    this.shaft.geometry = shaftShape(diameter, tipLength, length);
    this.face.geometry = faceShape(diameter, tipLength, false);
    this.bore.geometry = faceShape(diameter, tipLength, true);
    this.hub.build(diameter);
    this.hub.group.position.set(diameter / 2, 0, length);
  }

  place(tip: Vector3, axis: Vector3): void {
    placeNeedle(tip, axis, this.group.matrix);
    this.group.matrixWorldNeedsUpdate = true;
  }

  /** Shows blood at the bore's mouth and in the hub. Returns whether the picture changes. */
  step(inLumen: boolean, elapsedMs: number): boolean {
    this.mouth.color.copy(inLumen ? this.theme.color("blood") : EMPTY);
    return this.hub.step(inLumen, elapsedMs);
  }
}
