import { BufferAttribute, BufferGeometry, DynamicDrawUsage, LineBasicMaterial, LineSegments, Vector3 } from "three";
import type { FaceState } from "./slab.ts";
import { CORNERS, displacement } from "./slab_shape.ts";

const STEPS_PER_CELL = 4;

/** Grid lines on a face. They show its scale and its deformation. */
export class Grid {
  readonly lines: LineSegments;
  readonly material = new LineBasicMaterial({ transparent: true, depthWrite: false });
  private flat = new Float32Array(0); // x, y in the plane of the face
  private attribute = new BufferAttribute(new Float32Array(0), 3);
  private size = 0;
  private at: readonly [number, number] = [0, 0];

  constructor() {
    this.lines = new LineSegments(new BufferGeometry(), this.material);
    this.lines.frustumCulled = false;
    this.lines.renderOrder = 1;
  }

  /** size: half the side length; x0, y0: middle of the drawn part, mm. The lines stay in place if that moves. */
  private rule(size: number, x0: number, y0: number): void {
    this.size = size;
    this.at = [x0, y0];
    const cell = size > 11 ? 5 : size > 5 ? 2 : 1;
    const step = cell / STEPS_PER_CELL;
    const most = Math.floor(size / cell) * cell + cell;
    const within = (x: number, y: number): boolean =>
      Math.abs((x - x0) / size) ** CORNERS + Math.abs((y - y0) / size) ** CORNERS <= 1;
    const points: number[] = [];
    const put = (x: number, y: number, xs: number, ys: number): void => {
      if (within(x, y) && within(x + xs, y + ys)) points.push(x, y, x + xs, y + ys);
    };
    const [left, low] = [x0, y0].map((x) => Math.round(x / cell) * cell) as [number, number];
    for (let line = -most; line <= most + 1e-9; line += cell) {
      for (let at = -most; at < most - 1e-9; at += step) {
        put(left + line, low + at, 0, step);
        put(left + at, low + line, step, 0);
      }
    }
    this.flat = new Float32Array(points);
    this.attribute = new BufferAttribute(new Float32Array((points.length / 2) * 3), 3).setUsage(DynamicDrawUsage);
    this.lines.geometry.dispose();
    this.lines.geometry = new BufferGeometry().setAttribute("position", this.attribute);
  }

  dispose(): void {
    this.lines.geometry.dispose();
    this.material.dispose();
  }

  /** Updates the lines. origin: a point of the face; middle: of its drawn part; t1 and t2 span its plane. */
  update(
    origin: Vector3,
    middle: Vector3,
    t1: Vector3,
    t2: Vector3,
    face: FaceState,
    size: number,
    width: number,
  ): void {
    const away = middle.clone().sub(origin);
    const [x0, y0] = [away.dot(t1), away.dot(t2)];
    if (size !== this.size || Math.hypot(x0 - this.at[0], y0 - this.at[1]) > 0.02) this.rule(size, x0, y0);
    const out = this.attribute.array;
    const from = new Vector3().subVectors(face.centre, origin);
    const cx = from.dot(t1);
    const cy = from.dot(t2);
    const { shift } = face;
    for (let i = 0, o = 0; i < this.flat.length; i += 2) {
      const x = this.flat[i]!;
      const y = this.flat[i + 1]!;
      const border = Math.min(1, Math.max(Math.abs(x - x0), Math.abs(y - y0)) / size);
      const part = displacement(Math.hypot(x - cx, y - cy) - face.hole, width) * (1 - border ** 4);
      out[o++] = origin.x + x * t1.x + y * t2.x + part * shift.x;
      out[o++] = origin.y + x * t1.y + y * t2.y + part * shift.y;
      out[o++] = origin.z + x * t1.z + y * t2.z + part * shift.z;
    }
    this.attribute.needsUpdate = true;
  }
}
