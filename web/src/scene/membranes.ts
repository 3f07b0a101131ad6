import { FrontSide, Group, MeshBasicMaterial, Vector3 } from "three";
import { bounded } from "../tissue/field.ts";
import { follow } from "../tissue/grid.ts";
import type { SceneView } from "../wire/messages.ts";
import { bevelSide } from "./bevel.ts";
import { Grid } from "./grid.ts";
import type { Hole, Holes } from "./holes.ts";
import { BARRED, type MembraneMoment, MM, type Moment, OUTSIDE } from "./moment.ts";
import { Scars } from "./scars.ts";
import { type FaceState, Slab, untouched } from "./slab.ts";
import type { Theme } from "./theme.ts";

/** A face is drawn with at most this shift, mm, however far a hand drags the needle. */
const MOST_SHIFT = 9;

/** A membrane with its place and its drawn parts, mm. */
export interface Placed {
  readonly name: string;
  readonly point: Vector3;
  readonly normal: Vector3;
  readonly thickness: number;
  readonly faces: readonly [FaceState, FaceState];
  readonly slab: Slab;
  readonly material: MeshBasicMaterial;
  readonly scars: Scars;
  readonly grid: Grid;
}

/** The membranes: translucent slabs. The needle deforms them by the distance from its proxy to the tip, K06 (21). */
export class Membranes {
  readonly group = new Group();
  /** How far the drawn parts of the membranes have followed the needle, mm. */
  readonly offset = new Vector3();
  placed: Placed[] = [];
  size = 10;
  private diameter = 1;
  private tipLength = 3;

  constructor(private readonly theme: Theme) {
    theme.watch(() => this.paint());
  }

  build(scene: SceneView, size: number): void {
    for (const { slab, scars, grid, material } of this.placed) {
      for (const part of [slab, scars, grid, material]) part.dispose();
    }
    this.group.clear();
    this.size = size;
    this.diameter = scene.diameter * MM;
    this.tipLength = scene.tip_length * MM;
    this.placed = scene.membranes.map((membrane) => {
      const material = new MeshBasicMaterial({
        vertexColors: true,
        transparent: true, depthWrite: false, side: FrontSide,
      }); // biome-ignore format: short
      const slab = new Slab(material);
      const scars = new Scars();
      const grid = new Grid();
      this.group.add(slab.mesh, scars.mesh, grid.lines);
      return {
        name: membrane.name,
        point: new Vector3(...membrane.point).multiplyScalar(MM),
        normal: new Vector3(...membrane.inward_normal),
        thickness: membrane.thickness * MM,
        faces: [untouched(), untouched()],
        slab,
        material,
        scars,
        grid,
      };
    });
    this.paint();
  }

  private paint(): void {
    const { theme } = this;
    this.placed.forEach(({ material, slab, grid, scars }, i) => {
      material.color.copy(theme.membrane(i)).lerp(theme.color("panel"), 0.2);
      material.opacity = theme.dark ? 0.3 : 0.36;
      slab.edgeMaterial.color.copy(theme.membrane(i)).lerp(theme.color("text"), 0.15);
      grid.material.color.copy(theme.membrane(i)).lerp(theme.color("text"), 0.25);
      grid.material.opacity = (theme.dark ? 0.26 : 0.3) / Math.sqrt(Math.max(1, this.placed.length / 2));
      scars.paint(theme);
    });
  }

  /** Updates all slabs for the moment. Returns whether one changed. */
  update(moment: Moment, holes: Holes): boolean {
    let changed = false;
    this.follow(moment);
    this.placed.forEach((membrane, i) => {
      const state = moment.membranes[i];
      if (!state) return;
      const old = holes.of(i, moment.tick);
      const { point, normal, thickness, faces, slab, scars, grid } = membrane;
      const middle = this.middle(membrane);
      this.shape(membrane, state, moment, old.at(-1));
      faces.forEach((face, side) => {
        clampInto(face.centre, middle.clone().addScaledVector(normal, side * thickness), 0.92 * this.size);
        face.shift.clampLength(0, bounded(face.shift.length(), MOST_SHIFT));
      });
      const width = dimple(this.diameter, thickness);
      const needle = state.phase === OUTSIDE ? (old.at(-1)?.direction ?? normal) : moment.axis;
      if (slab.update(middle, normal, thickness, this.size, faces, width, needle)) {
        grid.update(point, middle, slab.t1, slab.t2, faces[0], this.size, width);
        changed = true;
      }
      if (scars.update(membrane, old, faces[0].centre, this.diameter)) changed = true;
    });
    return changed;
  }

  /** The model's membrane is infinite, and the drawn part of it follows the needle. */
  private follow(moment: Moment): void {
    const first = this.placed[0];
    if (!first) return;
    const { normal, point } = first;
    const tip = moment.tip.clone().sub(point);
    const depth = Math.max(0, tip.dot(normal));
    const entry = moment.axis
      .clone()
      .multiplyScalar(-depth / Math.max(0.2, moment.axis.dot(normal)))
      .add(tip);
    this.offset.addVectors(tip, entry).multiplyScalar(0.5);
    this.offset.addScaledVector(normal, -this.offset.dot(normal));
    this.offset.setLength(follow(this.offset.length(), 0.45 * this.size) || 1e-9);
  }

  /** The middle of the drawn part of a membrane's front face. */
  middle({ point, normal }: Placed): Vector3 {
    const along = this.offset.clone().addScaledVector(normal, -this.offset.dot(normal));
    return along.add(point);
  }

  private shape(membrane: Placed, state: MembraneMoment, moment: Moment, last: Hole | undefined): void {
    const [front, back] = membrane.faces;
    front.shift.set(0, 0, 0);
    back.shift.set(0, 0, 0);
    front.hole = 0;
    back.hole = 0;
    const inside = state.phase !== OUTSIDE && state.phase !== BARRED && state.direction.lengthSq() > 0.5;
    const direction = inside ? state.direction : last?.direction;
    if (!direction) {
      front.centre.copy(membrane.point);
      back.centre.copy(membrane.point);
      return;
    }
    const slope = direction.dot(membrane.normal);
    const path = membrane.thickness / Math.max(0.1, slope);
    const side = bevelSide(direction);
    if (!inside) {
      front.hole = back.hole = 0.42 * this.diameter;
      front.centre.copy(last!.front).addScaledVector(side, this.diameter / 2);
      back.centre.copy(front.centre).addScaledVector(direction, path);
      return;
    }
    const depth = state.proxy.clone().sub(membrane.point).dot(membrane.normal) / Math.max(0.1, slope);
    const lead = new Vector3().subVectors(moment.tip, state.proxy);
    const turn = new Vector3().subVectors(moment.axis, direction);
    const half = (at: number): number => (this.diameter / 2) * Math.min(1, Math.max(0, at) / this.tipLength);
    front.hole = half(depth);
    front.centre.copy(state.proxy).addScaledVector(direction, -depth).addScaledVector(side, front.hole);
    // The hole follows the drawn needle, even if it was tilted after the entry.
    front.shift.copy(lead).addScaledVector(turn, -depth);
    back.hole = half(depth - path);
    back.centre
      .copy(state.proxy)
      .addScaledVector(direction, path - depth)
      .addScaledVector(side, back.hole);
    if (depth > path) back.shift.copy(lead).addScaledVector(turn, path - depth);
    else back.shift.copy(lead).multiplyScalar(Math.exp((depth - path) / dimple(this.diameter, membrane.thickness)));
  }
}

/** Moves a point of a face towards the middle until it is not beyond `most`, mm. */
function clampInto(place: Vector3, middle: Vector3, most: number): void {
  place.sub(middle).clampLength(0, most).add(middle);
}

/** Width of a dimple, mm: some needle diameters, and wider in thick tissue. */
const dimple = (diameter: number, thickness: number): number => 1.6 * diameter + 0.35 * Math.min(thickness, 6);
