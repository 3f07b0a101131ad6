import { BufferAttribute, BufferGeometry, Color, DynamicDrawUsage, Line, LineBasicMaterial } from "three";
import type { Source } from "../state/source.ts";
import { TRAIL_SECONDS } from "./fade.ts";
import { MM } from "./moment.ts";
import type { Theme } from "./theme.ts";

const POINTS = 120;

/** The recent path of the tip. Older parts are paler. */
export class Trail {
  readonly line: Line;
  private readonly positions = new BufferAttribute(new Float32Array(3 * POINTS), 3).setUsage(DynamicDrawUsage);
  private readonly colors = new BufferAttribute(new Float32Array(3 * POINTS), 3);

  constructor(theme: Theme) {
    const geometry = new BufferGeometry().setAttribute("position", this.positions).setAttribute("color", this.colors);
    this.line = new Line(geometry, new LineBasicMaterial({ vertexColors: true, transparent: true, opacity: 0.8 }));
    this.line.frustumCulled = false;
    this.line.renderOrder = 3;
    theme.watch(() => {
      const between = new Color();
      for (let i = 0; i < POINTS; i++) {
        between.copy(theme.color("line")).lerp(theme.color("accent"), i / (POINTS - 1));
        between.toArray(this.colors.array, 3 * i);
      }
      this.colors.needsUpdate = true;
    });
  }

  /** rate: Hz. The points use the same ticks from frame to frame, so that the line does not flicker. */
  update(source: Source, tick: number, rate: number): void {
    const { history } = source;
    const step = Math.max(1, Math.round((TRAIL_SECONDS * rate) / POINTS));
    const tips = history.column("tip");
    const out = this.positions.array;
    let at = Math.max(history.first, Math.floor(tick / step) * step - (POINTS - 2) * step);
    for (let i = 0; i < POINTS; i++) {
      const here = 3 * history.slot(Math.min(at, tick));
      for (let axis = 0; axis < 3; axis++) out[3 * i + axis] = tips[here + axis]! * MM;
      at += step;
    }
    this.positions.needsUpdate = true;
  }
}
