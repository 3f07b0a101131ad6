import { ConeGeometry, CylinderGeometry, Group, Mesh, MeshLambertMaterial, Quaternion, Vector3 } from "three";
import type { Theme } from "./theme.ts";

const UP = new Vector3(0, 1, 0);
const SMALLEST_N = 0.005;

/** A force as an arrow next to the needle. Its length is proportional to the force. */
export class ForceArrow {
  readonly group = new Group();
  /** Position of the arrow's tip, where the number stands, mm. */
  readonly head = new Vector3();
  shown = 0;
  private readonly material = new MeshLambertMaterial({ transparent: true });
  private readonly shaft = new Mesh(new CylinderGeometry(1, 1, 1, 20).translate(0, 0.5, 0), this.material);
  private readonly cone = new Mesh(new ConeGeometry(1, 1, 24).translate(0, 0.5, 0), this.material);

  constructor(theme: Theme) {
    this.group.add(this.shaft, this.cone);
    // Drawn after the tissue, which would tint it. The needle still covers it.
    this.shaft.renderOrder = 5;
    this.cone.renderOrder = 5;
    this.group.visible = false;
    theme.watch(() => {
      this.material.color.copy(theme.color("data-2"));
      this.material.emissive.copy(theme.color("data-2")).multiplyScalar(0.25);
    });
  }

  /**
   * from: mm; force: N; mmPerNewton: scale; thick: radius of the shaft, mm. `real` is false for a force that the model
   * computes but the device does not output.
   */
  place(from: Vector3, force: Vector3, mmPerNewton: number, thick: number, real: boolean): void {
    this.shown = force.length();
    this.group.visible = this.shown > SMALLEST_N;
    if (!this.group.visible) return;
    const direction = force.clone().normalize();
    const length = this.shown * mmPerNewton;
    const head = Math.min(length * 0.6, thick * 5);
    this.group.position.copy(from);
    this.group.quaternion.copy(new Quaternion().setFromUnitVectors(UP, direction));
    this.shaft.scale.set(thick, Math.max(1e-3, length - head), thick);
    this.cone.position.y = length - head;
    this.cone.scale.set(thick * 2.3, head, thick * 2.3);
    this.material.opacity = real ? 1 : 0.35;
    this.head.copy(from).addScaledVector(direction, length);
  }
}
