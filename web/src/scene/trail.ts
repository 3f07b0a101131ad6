import { Color } from "three";
import { Line2 } from "three/examples/jsm/lines/Line2.js";
import { LineGeometry } from "three/examples/jsm/lines/LineGeometry.js";
import { LineMaterial } from "three/examples/jsm/lines/LineMaterial.js";
import type { Source } from "../state/source.ts";
import { MM } from "./moment.ts";
import type { Theme } from "./theme.ts";

const SECONDS = 2.5;
const POINTS = 240;

/** Where the tip has been lately; it fades into the colour of what is behind. */
export class Trail {
  readonly line: Line2;
  private readonly material = new LineMaterial({ linewidth: 2, vertexColors: true, transparent: true, opacity: 0.9 });
  private readonly positions = new Float32Array(3 * POINTS);
  private readonly colors = new Float32Array(3 * POINTS);
  private readonly head = new Color();
  private readonly tail = new Color();

  constructor(theme: Theme) {
    this.line = new Line2(new LineGeometry(), this.material);
    this.line.frustumCulled = false;
    theme.watch(() => {
      this.head.copy(theme.color("accent"));
      this.tail.copy(theme.color("panel"));
      const between = new Color();
      for (let i = 0; i < POINTS; i++) {
        between
          .copy(this.tail)
          .lerp(this.head, (i / (POINTS - 1)) ** 1.5)
          .toArray(this.colors, 3 * i);
      }
    });
  }

  /** rate: Hz. Points lie on ticks that stay the same from frame to frame, so that the line does not crawl. */
  lay(source: Source, tick: number, rate: number): void {
    const { history } = source;
    const step = Math.max(1, Math.round((SECONDS * rate) / POINTS));
    const tips = history.column("tip");
    let at = Math.max(history.first, Math.floor(tick / step) * step - (POINTS - 2) * step);
    for (let i = 0; i < POINTS; i++) {
      const here = 3 * history.slot(Math.min(at, tick));
      for (let axis = 0; axis < 3; axis++) this.positions[3 * i + axis] = tips[here + axis]! * MM;
      at += step;
    }
    this.line.geometry.setPositions(this.positions);
    this.line.geometry.setColors(this.colors);
  }
}
