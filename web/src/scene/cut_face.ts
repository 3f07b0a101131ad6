import { BufferGeometry, LineBasicMaterial, LineSegments } from "three";
import type { Field } from "../tissue/field.ts";
import { bendRow, COLUMNS, rowsOf, type Window } from "../tissue/grid.ts";
import type { Layer, Vessel } from "../tissue/layers.ts";
import { BlockMesh } from "./block_mesh.ts";
import type { Paper } from "./paper.ts";

/** The face of the cut: all layers, bent by the needle. An opened vessel is a groove in it. */
export class CutFace {
  readonly grid: BlockMesh;
  readonly borders: LineSegments;
  private readonly rows: readonly number[];
  private readonly rest: Float32Array;

  constructor(
    layers: readonly Layer[],
    private readonly vessel: Vessel | null,
    paper: Paper,
    private readonly diameter: number,
  ) {
    this.rows = rowsOf(layers);
    this.grid = new BlockMesh(this.rows.length, COLUMNS, paper.material);
    this.rest = new Float32Array(2 * this.rows.length * COLUMNS);
    // A thin line along the upper border of each membrane, bent with it.
    const tops = layers.filter(({ membrane }) => membrane !== null).map(({ top }) => this.rows.indexOf(top));
    const index = tops.flatMap((row) =>
      Array.from({ length: COLUMNS - 1 }, (_, i) => [row * COLUMNS + i, row * COLUMNS + i + 1]).flat(),
    );
    const lines = new BufferGeometry().setAttribute("position", this.grid.position).setIndex(index);
    this.borders = new LineSegments(
      lines,
      new LineBasicMaterial({ transparent: true, opacity: 0.4, depthWrite: false }),
    );
    this.borders.frustumCulled = false;
  }

  /** tip: depth of the needle's tip, mm. w: place of the plane. */
  update(field: Field, window: Window, w: number, tip: number, lean: number): void {
    const { rows, grid, rest } = this;
    const moved = grid.position.array as Float32Array;
    const uv = grid.uv.array as Float32Array;
    const shade = grid.shade.array as Float32Array;
    const bottom = rows.at(-1)!;
    rows.forEach((d, row) => {
      const at = row * COLUMNS;
      bendRow(field, d, bottom, window, rest, moved, at);
      const { depth, light } = this.groove(d);
      const even = (1.05 - (0.13 * d) / bottom) * light;
      for (let i = at; i < at + COLUMNS; i++) {
        uv[2 * i] = rest[2 * i]! / (2 * window.size) + 0.5;
        uv[2 * i + 1] = d / bottom;
        moved[3 * i + 2] = w - depth;
        shade[i] = even;
      }
      this.shadow(at, moved, shade, tip, lean);
    });
    grid.changed();
  }

  /** Depth of an opened vessel's groove, mm, and the light in it: round, as half a tube. */
  private groove(d: number): { depth: number; light: number } {
    const [top, bottom] = this.vessel?.inner ?? [0, 0];
    if (d <= top || d >= bottom) return { depth: 0, light: 1 };
    const across = (2 * d - top - bottom) / (bottom - top);
    return { depth: ((bottom - top) / 2) * Math.sqrt(Math.max(0, 1 - across * across)), light: 0.86 + 0.22 * across };
  }

  /** The needle's soft shadow, to the right of it: the light comes from the upper left. */
  private shadow(at: number, moved: Float32Array, shade: Float32Array, tip: number, lean: number): void {
    const { needle, diameter } = this;
    for (let i = at; i < at + COLUMNS; i++) {
      const d = moved[3 * i + 1]!;
      const past = (d - tip) / (1.5 * diameter);
      if (past > 3) return;
      const x = (moved[3 * i]! - needle(d)) * lean;
      const near = Math.exp(-((x / (1.1 * diameter)) ** 2));
      const cast = Math.exp(-(((x - 0.9 * diameter) / (1.25 * diameter)) ** 2));
      const reach = past > 0 ? Math.exp(-past * past) : 1;
      shade[i] = shade[i]! * (1 - reach * (0.14 * near + 0.34 * cast));
    }
  }
  /** Where the needle is at a depth, along the cut. */
  needle: (d: number) => number = () => 0;

  dispose(): void {
    this.grid.dispose();
    this.borders.geometry.dispose();
    (this.borders.material as LineBasicMaterial).dispose();
  }
}
