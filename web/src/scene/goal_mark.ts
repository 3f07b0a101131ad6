import { BoxGeometry, DoubleSide, Group, Matrix4, Mesh, MeshBasicMaterial, Quaternion, Vector3 } from "three";
import type { Goal } from "../state/app.ts";
import type { SceneView } from "../wire/messages.ts";
import { FatLine } from "./fat_line.ts";
import { MM } from "./moment.ts";
import type { Theme } from "./theme.ts";

const OPEN = 3; // mm, the drawn depth of a goal without an end
const FLAT = 0.1; // mm, its thickness on the cut
const SHARE = 0.62; // of the tissue's half side, so that the mark stands inside it

/** What an exercise asks to reach: a band between two depths, and the line that the point must meet. */
export class GoalMark {
  readonly group = new Group();
  /** Where its label belongs, mm. */
  readonly middle = new Vector3();
  /** Where it is drawn before it follows the tissue, mm. */
  private readonly from = new Vector3();
  private readonly normal = new Vector3();
  /** Of the goal's line; null without one. */
  private along: Vector3 | null = null;
  private readonly material = new MeshBasicMaterial({
    transparent: true,
    opacity: 0.3,
    depthTest: false,
    depthWrite: false,
    side: DoubleSide,
  });
  private readonly band = new Mesh(new BoxGeometry(1, 1, 1), this.material);
  private readonly line = new FatLine(3, 1);

  private inTissue = false;

  constructor(private readonly theme: Theme) {
    this.band.renderOrder = 3;
    this.group.add(this.band, this.line.line);
    this.group.visible = false;
    theme.watch(() => this.paint());
  }

  private paint(): void {
    const colour = this.theme.color(this.inTissue ? "goal" : "data-3");
    this.material.color.copy(colour);
    this.line.paint(colour);
  }

  /** size: half the side of the drawn tissue, mm. deepest: its bottom, mm below the first surface; else infinite. */
  show(goal: Goal | null, scene: SceneView | null, size: number, deepest = Number.POSITIVE_INFINITY): void {
    const first = scene?.membranes[0];
    this.group.visible = goal !== null && first !== undefined;
    if (!goal || !first) return;
    this.inTissue = Number.isFinite(deepest);
    this.paint();
    const normal = this.normal.set(...first.inward_normal).normalize();
    this.group.position.set(0, 0, 0);
    this.along = null;
    const [top, end] = bandOf(goal);
    const bottom = Math.max(top + 0.1, Math.min(end, deepest));
    const side = 2 * SHARE * size;
    this.band.position
      .set(...first.point)
      .multiplyScalar(MM)
      .addScaledVector(normal, (top + bottom) / 2);
    this.band.quaternion.copy(new Quaternion().setFromUnitVectors(new Vector3(0, -1, 0), normal));
    // On the cut itself: what stands before or behind it would be seen beside its own layer.
    this.band.scale.set(side, bottom - top, this.inTissue ? FLAT : side);
    this.from.copy(this.band.position);
    this.middle.copy(this.from);
    if (!goal.line) {
      this.line.setEnds(null);
      return;
    }
    this.along = new Vector3(...goal.line.along).normalize();
    const along = this.along.clone().multiplyScalar(size);
    const point = new Vector3(...goal.line.point).multiplyScalar(MM);
    this.line.setEnds([point.clone().sub(along), point.clone().add(along)]);
    this.band.scale.set(side, bottom - top, 2 * goal.line.within * MM);
    const direction = along.normalize();
    // The line runs along the surface: only its part at a right angle to the normal.
    direction.addScaledVector(normal, -direction.dot(normal)).normalize();
    const across = new Vector3().crossVectors(direction, normal.clone().negate());
    const axes = new Matrix4().makeBasis(direction, normal.clone().negate(), across);
    this.band.quaternion.setFromRotationMatrix(axes);
    this.band.position.copy(point).addScaledVector(normal, (top + bottom) / 2 - depthOf(point, first));
    this.from.copy(this.band.position);
    this.middle.copy(this.from);
  }

  /**
   * Moves it to the middle of the cut tissue, mm, which follows the needle: along its line, or along the surface.
   * cut: the direction along the surface in which the tissue is cut open.
   */
  follow(middle: Vector3, cut: Vector3): void {
    const { along, normal } = this;
    const way = middle.clone().sub(this.from);
    if (along) way.copy(along).multiplyScalar(middle.clone().sub(this.from).dot(along));
    else {
      way.addScaledVector(normal, -way.dot(normal));
      const up = normal.clone().negate();
      const axes = new Matrix4().makeBasis(cut, up, new Vector3().crossVectors(cut, up));
      this.band.quaternion.setFromRotationMatrix(axes);
    }
    this.group.position.copy(way);
    this.middle.copy(this.from).add(way);
  }
}

/** The drawn depths of a goal, mm. One without an end gets a short band. */
export function bandOf({ top, bottom }: Pick<Goal, "top" | "bottom">): [number, number] {
  const end = Number.isFinite(bottom) ? bottom * MM : top * MM + OPEN;
  return [top * MM, Math.max(end, top * MM + 0.1)];
}

function depthOf(point: Vector3, { point: surface, inward_normal: normal }: SceneView["membranes"][number]): number {
  return point
    .clone()
    .sub(new Vector3(...surface).multiplyScalar(MM))
    .dot(new Vector3(...normal));
}
