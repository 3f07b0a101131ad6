import { BufferAttribute, BufferGeometry, Group, LineBasicMaterial, LineSegments, type Scene } from "three";
import type { SceneView } from "../wire/messages.ts";
import { FatLine } from "./fat_line.ts";
import { type Probe, planeOf, skinFrame } from "./probe.ts";
import type { Theme } from "./theme.ts";

/** The slice's place in the 3-D view: a frame round its picture, and the probe's foot as a thick line on the skin. */
export class SliceFrame {
  private readonly group = new Group();
  private readonly corners = new BufferAttribute(new Float32Array(12), 3);
  private readonly material = new LineBasicMaterial({ transparent: true, opacity: 0.8, depthTest: false });
  private readonly foot = new FatLine(5, 0.9);
  private drawn: readonly unknown[] = [];

  constructor(theme: Theme, scene: Scene) {
    const shape = new BufferGeometry().setAttribute("position", this.corners).setIndex([0, 1, 1, 2, 2, 3, 3, 0]);
    const frame = new LineSegments(shape, this.material);
    frame.frustumCulled = false;
    frame.renderOrder = 4;
    this.group.add(frame, this.foot.line);
    this.group.visible = false;
    scene.add(this.group);
    theme.watch(() => {
      this.material.color.copy(theme.color("accent"));
      this.foot.paint(theme.color("accent"));
    });
  }

  /** Returns whether the picture changes. */
  update(scene: SceneView, probe: Probe): boolean {
    const now = [scene, probe.place.value, probe.picture.value] as const;
    if (now.every((value, i) => value === this.drawn[i])) return false;
    this.drawn = now;
    const picture = probe.picture.value;
    const before = this.group.visible;
    this.group.visible = picture !== null;
    if (!picture) return before;
    const { origin, along, inward } = planeOf(skinFrame(scene), probe.place.value);
    const half = picture.width / 2;
    const left = origin.clone().addScaledVector(along, -half);
    const right = origin.clone().addScaledVector(along, half);
    const corners = [
      left,
      right,
      right.clone().addScaledVector(inward, picture.depth),
      left.clone().addScaledVector(inward, picture.depth),
    ];
    corners.forEach((corner, i) => void corner.toArray(this.corners.array, 3 * i));
    this.corners.needsUpdate = true;
    this.foot.setEnds([left, right]);
    return true;
  }
}
