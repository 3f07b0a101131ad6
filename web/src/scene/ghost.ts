import { Group, Mesh, MeshBasicMaterial, type Vector3 } from "three";
import type { SceneView } from "../wire/messages.ts";
import { placeNeedle } from "./bevel.ts";
import { FatLine } from "./fat_line.ts";
import { MM } from "./moment.ts";
import { needleLook } from "./needle_look.ts";
import { shaftShape } from "./needle_shape.ts";
import type { Theme } from "./theme.ts";

/** The target pose of the hand, and the spring between it and the needle. */
export class Ghost {
  readonly group = new Group();
  private readonly needle = new Group();
  private readonly material = new MeshBasicMaterial({ transparent: true, opacity: 0.16, depthWrite: false });
  private readonly spring = new FatLine(1.5, 0.8);

  constructor(theme: Theme) {
    this.needle.matrixAutoUpdate = false;
    this.group.add(this.needle, this.spring.line);
    this.group.visible = false;
    theme.watch(() => {
      this.material.color.copy(theme.color("accent"));
      this.spring.paint(theme.color("accent"));
    });
  }

  build(scene: SceneView, length: number): void {
    for (const child of this.needle.children) if (child instanceof Mesh) child.geometry.dispose();
    this.needle.clear();
    const mesh = new Mesh(
      shaftShape(scene.diameter * MM, scene.tip_length * MM, length, needleLook(scene)),
      this.material,
    );
    mesh.renderOrder = 2;
    this.needle.add(mesh);
  }

  /** Shows the target, mm; null hides it. */
  place(target: { position: Vector3; axis: Vector3 } | null, tip: Vector3): void {
    this.group.visible = target !== null;
    if (!target) return;
    placeNeedle(target.position, target.axis, this.needle.matrix);
    this.needle.matrixWorldNeedsUpdate = true;
    this.spring.setEnds(target.position.distanceTo(tip) > 0.02 ? [target.position, tip] : null);
  }
}
