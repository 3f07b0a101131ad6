import { BufferAttribute, BufferGeometry, Group, Mesh, MeshBasicMaterial } from "three";
import type { Layer } from "../tissue/layers.ts";
import type { Paper } from "./paper.ts";
import type { Theme } from "./theme.ts";

const STRIPE = 0.025; // of the place of its right end

/** The still parts of the block: its ends, its bottom, and the colour stripes. */
export class Ends {
  readonly group = new Group();
  /** The colours of the membranes in the plots. */
  readonly bars: Mesh;
  private readonly below = new MeshBasicMaterial();
  private readonly stripes = new MeshBasicMaterial({ vertexColors: true });
  private readonly colours: BufferAttribute;
  private readonly marked: readonly Layer[];
  private readonly meshes: Mesh[];

  constructor(layers: readonly Layer[], [from, to]: readonly [number, number], deep: number, paper: Paper) {
    const bottom = layers.at(-1)!.bottom;
    const end = (u: number, shade: number): Mesh =>
      new Mesh(quad([u, 0, 0], [u, 0, -deep], [u, bottom, 0], [u, bottom, -deep], shade), paper.material);
    const floor = new Mesh(
      quad([from, bottom, 0], [to, bottom, 0], [from, bottom, -deep], [to, bottom, -deep], 1),
      this.below,
    );
    this.marked = layers.filter(({ membrane }) => membrane !== null);
    const wide = STRIPE * to;
    const bars = this.marked.flatMap(({ top, bottom: low }) => {
      const [left, right] = [from - 2.2 * wide, from - 0.7 * wide];
      return [[left, top], [left, low], [right, top], [right, top], [left, low], [right, low]].flatMap(
        ([u, d]) => [u!, d!, 0]);
    }); // biome-ignore format: two triangles
    this.colours = new BufferAttribute(new Float32Array(bars.length), 3);
    const striped = new BufferGeometry()
      .setAttribute("position", new BufferAttribute(new Float32Array(bars), 3))
      .setAttribute("color", this.colours);
    this.stripes.side = floor.material.side = 2;
    this.bars = new Mesh(striped, this.stripes);
    this.meshes = [end(to, 0.8), end(from, 0.66), floor, this.bars];
    this.group.add(...this.meshes);
  }

  paint(theme: Theme): void {
    this.below.color.setRGB(0.18, 0.09, 0.07);
    this.marked.forEach(({ membrane }, i) => {
      const colour = theme.membrane(membrane!);
      for (let corner = 0; corner < 6; corner++) colour.toArray(this.colours.array, 18 * i + 3 * corner);
    });
    this.colours.needsUpdate = true;
  }

  dispose(): void {
    for (const { geometry } of this.meshes) geometry.dispose();
    for (const material of [this.below, this.stripes]) material.dispose();
  }
}

type Triple = readonly [number, number, number];

/** Four corners: texture (0, 0), (1, 0), (0, 1), (1, 1). */
function quad(a: Triple, b: Triple, c: Triple, d: Triple, shade: number): BufferGeometry {
  return new BufferGeometry()
    .setAttribute("position", new BufferAttribute(new Float32Array([...a, ...b, ...c, ...d]), 3))
    .setAttribute("uv", new BufferAttribute(new Float32Array([0, 0, 1, 0, 0, 1, 1, 1]), 2))
    .setAttribute("shade", new BufferAttribute(new Float32Array(4).fill(shade), 1))
    .setIndex([0, 1, 2, 2, 1, 3]);
}
