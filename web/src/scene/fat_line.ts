import { type Color, Quaternion, Vector3 } from "three";
import { Line2 } from "three/examples/jsm/lines/Line2.js";
import { LineGeometry } from "three/examples/jsm/lines/LineGeometry.js";
import { LineMaterial } from "three/examples/jsm/lines/LineMaterial.js";

const UP = new Vector3(0, 1, 0);

/** A straight line with a width in pixels; `dash` is the length of a dash, mm. Moving it allocates no geometry. */
export class FatLine {
  readonly line: Line2;
  private readonly material: LineMaterial;
  private readonly way = new Vector3();

  constructor(pixels: number, opacity: number, dash?: number) {
    this.material = new LineMaterial({
      linewidth: pixels,
      transparent: true,
      opacity,
      depthTest: false,
      dashed: dash !== undefined,
      dashSize: dash ?? 1,
      gapSize: (dash ?? 1) * 0.7,
    });
    this.line = new Line2(new LineGeometry().setPositions([0, 0, 0, 0, 1, 0]), this.material);
    this.line.computeLineDistances();
    this.line.frustumCulled = false;
    this.line.renderOrder = 4;
    this.line.visible = false;
  }

  paint(color: Color): void {
    this.material.color.copy(color);
  }

  /** Sets the two ends, mm; null hides the line. */
  setEnds(ends: readonly [Vector3, Vector3] | null): void {
    const length = ends ? this.way.subVectors(ends[1], ends[0]).length() : 0;
    this.line.visible = length > 1e-6;
    if (!ends || !this.line.visible) return;
    this.line.position.copy(ends[0]);
    this.line.quaternion.copy(new Quaternion().setFromUnitVectors(UP, this.way.divideScalar(length)));
    this.line.scale.set(1, length, 1);
    this.material.dashScale = length;
  }
}
