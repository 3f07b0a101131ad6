import { Mesh } from "three";
import type { Field } from "../tissue/field.ts";
import { bendRow, border, COLUMNS, type Window } from "../tissue/grid.ts";
import { BlockMesh } from "./block_mesh.ts";
import type { Paper } from "./paper.ts";

const ROWS = 14;
const spot = { track: 0, u: 0, down: 0 };

/** The surface of the tissue behind the cut, and the same in front of it for a camera that looks from above. */
export class Surface {
  readonly grid: BlockMesh;
  /** The half in front of the cut. */
  readonly front: Mesh;
  private readonly rest = new Float32Array(2 * COLUMNS);
  private readonly edge = new Float32Array(3 * COLUMNS);

  constructor(
    paper: Paper,
    frontPaper: Paper,
    private readonly deep: number,
  ) {
    this.grid = new BlockMesh(ROWS, COLUMNS, paper.material);
    this.front = new Mesh(this.grid.mesh.geometry, frontPaper.material);
    this.front.frustumCulled = false;
    this.front.visible = false;
    this.front.scale.z = -1;
  }

  /** w: place of the cut. The pattern stays in place when the window moves. */
  update(field: Field, window: Window, w: number): void {
    const { grid, rest, edge, deep } = this;
    const position = grid.position.array as Float32Array;
    const uv = grid.uv.array as Float32Array;
    bendRow(field, 0, Number.POSITIVE_INFINITY, window, rest, edge, 0);
    field.at(0, spot);
    const wide = 2 * window.size;
    for (let row = 0; row < ROWS; row++) {
      const part = (row / (ROWS - 1)) ** 1.8;
      const back = deep * part;
      for (let i = 0; i < COLUMNS; i++) {
        const at = row * COLUMNS + i;
        const u = rest[2 * i]!;
        const share = field.share(Math.hypot(u - spot.track, back)) * border(u, window) * (1 - part ** 4);
        position[3 * at] = u + share * spot.u;
        position[3 * at + 1] = share * spot.down;
        position[3 * at + 2] = w - back;
        uv[2 * at] = u / wide;
        uv[2 * at + 1] = (w - back) / wide;
      }
    }
    this.front.position.z = 2 * w;
    this.light();
    grid.changed();
  }

  /** Brightness by the slope: light from the upper left in front. */
  private light(): void {
    const position = this.grid.position.array;
    const shade = this.grid.shade.array as Float32Array;
    const slope = (a: number, b: number, axis: number): number => {
      const run = position[3 * b + axis]! - position[3 * a + axis]!;
      return Math.abs(run) > 1e-9 ? (position[3 * b + 1]! - position[3 * a + 1]!) / run : 0;
    };
    for (let row = 0; row < ROWS; row++) {
      for (let i = 0; i < COLUMNS; i++) {
        const at = row * COLUMNS + i;
        const du = slope(i > 0 ? at - 1 : at, i + 1 < COLUMNS ? at + 1 : at, 0);
        const dw = slope(row > 0 ? at - COLUMNS : at, row + 1 < ROWS ? at + COLUMNS : at, 2);
        // The normal is (du, -1, dw), the light comes from (-0.4, -0.8, 0.45).
        const towards = (-0.4 * du + 0.8 + 0.45 * dw) / Math.sqrt(du * du + dw * dw + 1);
        shade[at] = 0.62 + 0.47 * Math.max(0, towards);
      }
    }
  }

  dispose(): void {
    this.grid.dispose();
  }
}
