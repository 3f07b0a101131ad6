import type { Color, Vector3 } from "three";
import { Line2 } from "three/examples/jsm/lines/Line2.js";
import { LineGeometry } from "three/examples/jsm/lines/LineGeometry.js";
import { LineMaterial } from "three/examples/jsm/lines/LineMaterial.js";

/** A straight line of a width in pixels, which may be dashed. */
export class FatLine {
  readonly line: Line2;
  private readonly material: LineMaterial;

  constructor(pixels: number, opacity: number, dash?: number) {
    this.material = new LineMaterial({
      linewidth: pixels, transparent: true, opacity, depthTest: false, dashed: dash !== undefined,
      dashSize: dash ?? 1, gapSize: (dash ?? 1) * 0.7,
    }); // biome-ignore format: short
    this.line = new Line2(new LineGeometry(), this.material);
    this.line.frustumCulled = false;
    this.line.renderOrder = 4;
    this.line.visible = false;
  }

  paint(color: Color): void {
    this.material.color.copy(color);
  }

  /** null hides it. */
  between(ends: readonly [Vector3, Vector3] | null): void {
    this.line.visible = ends !== null;
    if (!ends) return;
    this.line.geometry.setPositions([...ends[0].toArray(), ...ends[1].toArray()]);
    this.line.computeLineDistances();
  }
}
