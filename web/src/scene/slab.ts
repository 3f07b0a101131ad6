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
import { AROUND, CORNERS, displacement, RINGS, slabEdges, slabTriangles, tangents } from "./slab_shape.ts";

const LIGHT = new Vector3(0.35, 0.8, 0.5).normalize();

/** The deformation of one face of a slab by the needle, mm. */
export interface FaceState {
  /** Point of the undeformed face that the needle goes through. */
  readonly centre: Vector3;
  /** Radius of the hole; 0 is none. */
  hole: number;
  /** Displacement of the tissue at the needle. */
  readonly shift: Vector3;
}

export const untouched = (): FaceState => ({ centre: new Vector3(), hole: 0, shift: new Vector3() });

/**
 * A slab of tissue: two faces, a rim and the wall of the hole. Each face is a mesh of rings round the needle, fine at
 * the needle and coarse at the border. A face deforms like a half-space under a point load, and is fixed at the border.
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
   * Updates the slab. Returns false if nothing changed.
   * middle: centre of the front face; normal: inward, of length 1; size: half the side length; width: of the dimple;
   * needle: direction of the needle, for a slanted hole. Lengths in mm.
   */
  update(
    middle: Vector3,
    normal: Vector3,
    thickness: number,
    size: number,
    faces: readonly [FaceState, FaceState],
    width: number,
    needle: Vector3,
  ): boolean {
    const key = this.key(faces, size, width, thickness, needle);
    if (key === this.last) return false;
    this.last = key;
    tangents(normal, this.t1, this.t2);
    const perFace = 3 * (RINGS + 1) * (AROUND + 1);
    const row = 3 * (AROUND + 1);
    faces.forEach((face, side) => {
      const origin = middle.clone().addScaledVector(normal, side * thickness);
      this.updateFace(side * perFace, origin, face, size, width, needle);
    });
    // The rim and the hole do not share vertices with the faces, so that edges stay sharp.
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

  /** Bakes light from above into the vertex colours: a large translucent face is then cheap to draw without a GPU. */
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

  private updateFace(at: number, origin: Vector3, face: FaceState, size: number, width: number, needle: Vector3): void {
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
        // A slanted cylinder cuts the face in an ellipse.
        const hole = face.hole / Math.sqrt(Math.max(0.05, 1 - (c * slant[0] + s * slant[1]) ** 2));
        const border = size / (Math.abs(c) ** CORNERS + Math.abs(s) ** CORNERS) ** (1 / CORNERS);
        const x = (cx + hole * c) * (1 - part) + border * c * part;
        const y = (cy + hole * s) * (1 - part) + border * s * part;
        const along = (1 - part) * displacement(Math.hypot(x - cx, y - cy) - hole, width);
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
