import {
  BufferAttribute,
  BufferGeometry,
  DynamicDrawUsage,
  LineBasicMaterial,
  LineSegments,
  type Material,
  Mesh,
  Vector3,
} from "three";
import { AROUND, CORNERS, carried, RINGS, slabEdges, slabTriangles, tangents } from "./slab_shape.ts";

const LIGHT = new Vector3(0.35, 0.8, 0.5).normalize();

/** What a needle does to one face of a slab. mm, in the slab's own plane where there are two numbers. */
export interface FaceState {
  /** Where the tissue's own points meet the needle, before it gave way. */
  readonly centre: Vector3;
  /** Radius of the hole; 0 is none. */
  hole: number;
  /** How far the tissue at the needle is carried along. */
  readonly shift: Vector3;
}

export const untouched = (): FaceState => ({ centre: new Vector3(), hole: 0, shift: new Vector3() });

/**
 * A slab of tissue: two faces of rings round the needle, fine at it and coarse at the border, a rim, and the wall of
 * the hole.
 * A face gives way as a half-space does under a point, and is held at the border.
 */
export class Slab {
  readonly mesh: Mesh;
  readonly edgeMaterial = new LineBasicMaterial({ transparent: true, opacity: 0.55, depthWrite: false });
  private readonly edges: LineSegments;
  private readonly positions: Float32Array;
  private readonly attribute: BufferAttribute;
  private readonly colors: BufferAttribute;
  readonly t1 = new Vector3();
  readonly t2 = new Vector3();
  private last = "";

  constructor(material: Material) {
    const perFace = (RINGS + 1) * (AROUND + 1);
    const vertices = 2 * perFace + 4 * (AROUND + 1);
    const geometry = new BufferGeometry();
    this.positions = new Float32Array(3 * vertices);
    this.attribute = new BufferAttribute(this.positions, 3).setUsage(DynamicDrawUsage);
    geometry.setAttribute("position", this.attribute);
    this.colors = new BufferAttribute(new Float32Array(3 * vertices), 3).setUsage(DynamicDrawUsage);
    geometry.setAttribute("color", this.colors);
    geometry.setIndex(slabTriangles());
    this.mesh = new Mesh(geometry, material);
    this.mesh.frustumCulled = false;
    const edges = new BufferGeometry().setAttribute("position", this.attribute).setIndex(slabEdges());
    this.edges = new LineSegments(edges, this.edgeMaterial);
    this.edges.frustumCulled = false;
    this.edges.renderOrder = 2;
    this.mesh.add(this.edges);
  }

  /**
   * Lays the slab anew; false where nothing differs from the last time.
   * middle: of the front face; normal: inward, of length 1; size: half the side; needle: its direction, for a
   * slanted hole.
   */
  lay(
    middle: Vector3,
    normal: Vector3,
    thickness: number,
    size: number,
    faces: readonly [FaceState, FaceState],
    width: number,
    needle: Vector3,
  ): boolean {
    // biome-ignore format: two lines of arguments
    const key = this.key(faces, size, width, thickness, needle);
    if (key === this.last) return false;
    this.last = key;
    tangents(normal, this.t1, this.t2);
    const perFace = 3 * (RINGS + 1) * (AROUND + 1);
    const row = 3 * (AROUND + 1);
    faces.forEach((face, side) => {
      const origin = middle.clone().addScaledVector(normal, side * thickness);
      this.layFace(side * perFace, origin, face, size, width, needle);
    });
    // Rim and hole have points of their own, so that edges stay sharp.
    const { positions } = this;
    faces.forEach((_, side) => {
      const face = side * perFace;
      positions.copyWithin(2 * perFace + side * row, face + RINGS * row, face + (RINGS + 1) * row);
      positions.copyWithin(2 * perFace + (2 + side) * row, face, face + row);
    });
    this.attribute.needsUpdate = true;
    this.mesh.geometry.computeVertexNormals();
    this.shade();
    return true;
  }

  /**
   * Light from above, laid into the colours: a translucent face of many pixels is then cheap to draw, also without
   * a graphics card.
   */
  private shade(): void {
    const normals = this.mesh.geometry.getAttribute("normal").array;
    const colors = this.colors.array;
    for (let i = 0; i < colors.length; i += 3) {
      const towards = normals[i]! * LIGHT.x + normals[i + 1]! * LIGHT.y + normals[i + 2]! * LIGHT.z;
      const level = towards > 0 ? 0.86 + 0.3 * towards : 0.86 + 0.26 * towards;
      colors[i] = level;
      colors[i + 1] = level;
      colors[i + 2] = level;
    }
    this.colors.needsUpdate = true;
  }

  private layFace(at: number, origin: Vector3, face: FaceState, size: number, width: number, needle: Vector3): void {
    // biome-ignore format: one line of arguments
    const { t1, t2, positions } = this;
    const from = new Vector3().subVectors(face.centre, origin);
    const cx = from.dot(t1);
    const cy = from.dot(t2);
    const slant = [needle.dot(t1), needle.dot(t2)] as const;
    let out = at;
    for (let ring = 0; ring <= RINGS; ring++) {
      const part = (ring / RINGS) ** 2.4;
      for (let i = 0; i <= AROUND; i++) {
        const c = Math.cos((2 * Math.PI * i) / AROUND);
        const s = Math.sin((2 * Math.PI * i) / AROUND);
        // A cylinder that meets the face at a slant cuts an ellipse.
        const hole = face.hole / Math.sqrt(Math.max(0.05, 1 - (c * slant[0] + s * slant[1]) ** 2));
        const border = size / (Math.abs(c) ** CORNERS + Math.abs(s) ** CORNERS) ** (1 / CORNERS);
        const x = (cx + hole * c) * (1 - part) + border * c * part;
        const y = (cy + hole * s) * (1 - part) + border * s * part;
        const along = (1 - part) * carried(Math.hypot(x - cx, y - cy) - hole, width);
        positions[out++] = origin.x + x * t1.x + y * t2.x + along * face.shift.x;
        positions[out++] = origin.y + x * t1.y + y * t2.y + along * face.shift.y;
        positions[out++] = origin.z + x * t1.z + y * t2.z + along * face.shift.z;
      }
    }
  }

  dispose(): void {
    this.mesh.geometry.dispose();
    this.edges.geometry.dispose();
    this.edgeMaterial.dispose();
  }

  private key(faces: readonly FaceState[], size: number, width: number, thickness: number, needle: Vector3): string {
    const parts = [size, width, thickness];
    for (const { centre, hole, shift } of faces) {
      parts.push(centre.x, centre.y, centre.z, hole, shift.x, shift.y, shift.z);
      if (hole > 0) parts.push(needle.x, needle.y, needle.z);
    }
    return parts.map((value) => value.toFixed(2)).join(" ");
  }
}
