import { FrontSide, MeshBasicMaterial, type Vector3 } from "three";
import type { Membranes, Placed } from "./membranes.ts";
import { type FaceState, Slab } from "./slab.ts";
import type { Theme } from "./theme.ts";

/** The lumen: blood between two membranes. Its surfaces deform with theirs. */
export class Blood {
  private readonly material = new MeshBasicMaterial({
    vertexColors: true,
    transparent: true, opacity: 0.5, depthWrite: false, side: FrontSide,
  }); // biome-ignore format: short
  readonly slab = new Slab(this.material);
  private walls: readonly [number, number] | null = null;

  constructor(theme: Theme) {
    this.slab.mesh.visible = false;
    theme.watch(() => {
      this.material.color.copy(theme.color("blood"));
      this.slab.edgeMaterial.color.copy(theme.color("blood"));
      this.slab.edgeMaterial.opacity = 0.25;
      this.material.opacity = theme.dark ? 0.55 : 0.45;
    });
  }

  /** asSlab: whether this draws the blood, as a slab. */
  build(lumen: readonly number[], asSlab = true): void {
    this.walls = lumen.length === 2 ? [lumen[0]!, lumen[1]!] : null;
    this.slab.mesh.visible = asSlab && this.walls !== null;
  }

  update(membranes: Membranes, axis: Vector3): boolean {
    const [front, back] = this.placed(membranes);
    if (!front || !back) return false;
    const top = membranes.middle(front).addScaledVector(front.normal, front.thickness);
    const deep = Math.max(0, back.point.clone().sub(top).dot(front.normal));
    const faces: [FaceState, FaceState] = [front.faces[1], back.faces[0]];
    return this.slab.update(top, front.normal, deep, 0.985 * membranes.size, faces, 3, axis);
  }

  private placed({ placed }: Membranes): [Placed | undefined, Placed | undefined] {
    return this.walls ? [placed[this.walls[0]], placed[this.walls[1]]] : [undefined, undefined];
  }
}
