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

  constructor() {
    this.lines = new LineSegments(new BufferGeometry(), this.material);
    this.lines.frustumCulled = false;
    this.lines.renderOrder = 1;
  }

  /** size: half the side length, mm. */
  private rule(size: number): void {
    this.size = size;
    const cell = size > 11 ? 5 : size > 5 ? 2 : 1;
    const step = cell / STEPS_PER_CELL;
    const most = Math.floor(size / cell) * cell;
    const within = (x: number, y: number): boolean =>
      Math.abs(x / size) ** CORNERS + Math.abs(y / size) ** CORNERS <= 1;
    const points: number[] = [];
    for (let line = -most; line <= most + 1e-9; line += cell) {
      for (let at = -most - cell; at < most + cell - 1e-9; at += step) {
        if (within(line, at) && within(line, at + step)) {
          points.push(line, at, line, at + step, at, line, at + step, line);
        }
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

  /** Updates the lines. origin: a point of the face; t1 and t2 span its plane. */
  update(origin: Vector3, t1: Vector3, t2: Vector3, face: FaceState, size: number, width: number): void {
    if (size !== this.size) this.rule(size);
    const out = this.attribute.array;
    const from = new Vector3().subVectors(face.centre, origin);
    const cx = from.dot(t1);
    const cy = from.dot(t2);
    const { shift } = face;
    for (let i = 0, o = 0; i < this.flat.length; i += 2) {
      const x = this.flat[i]!;
      const y = this.flat[i + 1]!;
      const border = Math.max(Math.abs(x), Math.abs(y)) / size;
      const part = displacement(Math.hypot(x - cx, y - cy) - face.hole, width) * (1 - border ** 4);
      out[o++] = origin.x + x * t1.x + y * t2.x + part * shift.x;
      out[o++] = origin.y + x * t1.y + y * t2.y + part * shift.y;
      out[o++] = origin.z + x * t1.z + y * t2.z + part * shift.z;
    }
    this.attribute.needsUpdate = true;
  }
}
