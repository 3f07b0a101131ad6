import { CircleGeometry, DoubleSide, InstancedMesh, Matrix4, MeshBasicMaterial, Vector3 } from "three";
import { bevelSide } from "./bevel.ts";
import type { Hole } from "./holes.ts";
import type { Theme } from "./theme.ts";

const MOST = 40;

/** Holes without a needle in them: dark spots on both faces. */
export class Scars {
  readonly mesh: InstancedMesh;
  private readonly material = new MeshBasicMaterial({
    transparent: true,
    opacity: 0.55,
    side: DoubleSide,
    depthWrite: false,
  });
  private last = "";

  constructor() {
    this.mesh = new InstancedMesh(new CircleGeometry(0.5, 24), this.material, 2 * MOST);
    this.mesh.count = 0;
    this.mesh.frustumCulled = false;
    this.mesh.renderOrder = 1;
  }

  paint(theme: Theme): void {
    this.material.color.copy(theme.color("blood")).multiplyScalar(0.6);
  }

  /** open: centre of the hole that the slab itself draws; it is left out here. */
  update(
    membrane: { normal: Vector3; thickness: number },
    holes: readonly Hole[],
    open: Vector3,
    diameter: number,
  ): boolean {
    // biome-ignore format: one line of arguments
    const middle = ({ front, direction }: Hole): Vector3 =>
      front.clone().addScaledVector(bevelSide(direction), diameter / 2);
    const shown = holes.filter((hole) => middle(hole).distanceTo(open) > 0.6 * diameter).slice(-MOST);
    const key = `${shown.map(({ tick }) => tick).join()} ${diameter}`;
    if (key === this.last) return false;
    this.last = key;
    const { normal, thickness } = membrane;
    let at = 0;
    for (const hole of shown) {
      const { direction } = hole;
      const front = middle(hole);
      const slope = Math.max(0.1, direction.dot(normal));
      const back = front.clone().addScaledVector(direction, thickness / slope);
      const across = new Vector3().copy(direction).addScaledVector(normal, -slope);
      const x = across.lengthSq() > 1e-6 ? across.normalize() : new Vector3(1, 0, 0).cross(normal).normalize();
      const y = new Vector3().crossVectors(normal, x);
      for (const [place, side] of [
        [front, -0.03],
        [back, 0.03],
      ] as const) {
        const to = place.clone().addScaledVector(normal, side);
        const spot = new Matrix4().makeBasis(
          x.clone().multiplyScalar((0.8 * diameter) / slope), y.clone().multiplyScalar(0.8 * diameter), normal,
        ); // biome-ignore format: one line of arguments
        this.mesh.setMatrixAt(at++, spot.setPosition(to));
      }
    }
    this.mesh.count = at;
    this.mesh.instanceMatrix.needsUpdate = true;
    return true;
  }

  dispose(): void {
    this.mesh.geometry.dispose();
    this.material.dispose();
    this.mesh.dispose();
  }
}
