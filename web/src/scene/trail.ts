import { Color, type InterleavedBufferAttribute } from "three";
import { Line2 } from "three/examples/jsm/lines/Line2.js";
import { LineGeometry } from "three/examples/jsm/lines/LineGeometry.js";
import { LineMaterial } from "three/examples/jsm/lines/LineMaterial.js";
import type { Source } from "../state/source.ts";
import { MM } from "./moment.ts";
import type { Theme } from "./theme.ts";

export const TRAIL_SECONDS = 2.5;
const POINTS = 240;

/** Where the tip has been lately, paler the longer ago. */
export class Trail {
  readonly line: Line2;
  private readonly material = new LineMaterial({ linewidth: 2, vertexColors: true, transparent: true, opacity: 0.6 });
  private readonly geometry = new LineGeometry();
  /** Of the line's pieces: start and end of each, as the graphics card has them. */
  private readonly pieces: Float32Array;
  private readonly points = new Float32Array(3 * POINTS);

  constructor(theme: Theme) {
    this.geometry.setPositions(this.points);
    this.pieces = (this.geometry.getAttribute("instanceStart") as InterleavedBufferAttribute).data
      .array as Float32Array;
    this.line = new Line2(this.geometry, this.material);
    this.line.frustumCulled = false;
    theme.watch(() => {
      const colors = new Float32Array(3 * POINTS);
      const between = new Color();
      for (let i = 0; i < POINTS; i++) {
        between.copy(theme.color("line")).lerp(theme.color("accent"), i / (POINTS - 1));
        between.toArray(colors, 3 * i);
      }
      this.geometry.setColors(colors);
    });
  }

  /** rate: Hz. Points lie on ticks that stay the same from frame to frame, so that the line does not crawl. */
  lay(source: Source, tick: number, rate: number): void {
    const { history } = source;
    const step = Math.max(1, Math.round((TRAIL_SECONDS * rate) / POINTS));
    const tips = history.column("tip");
    let at = Math.max(history.first, Math.floor(tick / step) * step - (POINTS - 2) * step);
    for (let i = 0; i < POINTS; i++) {
      const here = 3 * history.slot(Math.min(at, tick));
      for (let axis = 0; axis < 3; axis++) this.points[3 * i + axis] = tips[here + axis]! * MM;
      at += step;
    }
    for (let i = 0; i + 1 < POINTS; i++) this.pieces.set(this.points.subarray(3 * i, 3 * i + 6), 6 * i);
    (this.geometry.getAttribute("instanceStart") as InterleavedBufferAttribute).data.needsUpdate = true;
  }
}
