import { BufferAttribute, BufferGeometry, DynamicDrawUsage, Mesh, type ShaderMaterial } from "three";
import { gridTriangles } from "../tissue/grid.ts";

/** A grid of points whose positions, texture coordinates and brightness change from frame to frame. */
export class BlockMesh {
  readonly mesh: Mesh;
  readonly position: BufferAttribute;
  readonly uv: BufferAttribute;
  readonly shade: BufferAttribute;

  constructor(rows: number, columns: number, material: ShaderMaterial) {
    const count = rows * columns;
    const changing = (size: number): BufferAttribute =>
      new BufferAttribute(new Float32Array(size * count), size).setUsage(DynamicDrawUsage);
    this.position = changing(3);
    this.uv = changing(2);
    this.shade = changing(1);
    const geometry = new BufferGeometry()
      .setAttribute("position", this.position)
      .setAttribute("uv", this.uv)
      .setAttribute("shade", this.shade)
      .setIndex(gridTriangles(rows, columns));
    this.mesh = new Mesh(geometry, material);
    this.mesh.frustumCulled = false;
  }

  changed(): void {
    this.position.needsUpdate = this.uv.needsUpdate = this.shade.needsUpdate = true;
  }

  dispose(): void {
    this.mesh.geometry.dispose();
  }
}
