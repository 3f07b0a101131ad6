import { BufferAttribute, BufferGeometry, DoubleSide, DynamicDrawUsage, Mesh, MeshBasicMaterial } from "three";
import type { Field } from "../tissue/field.ts";
import type { Window } from "../tissue/grid.ts";
import type { Layer } from "../tissue/layers.ts";
import type { Cut } from "./cut.ts";
import type { Hole } from "./holes.ts";

const MOST = 48;
const PIECES = 5; // of a track through one membrane
const NEAR = 0.9; // mm from the cut: a track that is farther away is not seen in it

/** The wounds of earlier punctures: dark lines through the membranes in the cut, which move with the tissue. */
export class Tracks {
  readonly mesh: Mesh;
  private readonly position = new BufferAttribute(new Float32Array(MOST * (PIECES + 1) * 2 * 3), 3);
  private readonly material = new MeshBasicMaterial({
    color: 0x5a0d16,
    transparent: true,
    opacity: 0.7,
    depthWrite: false,
    side: DoubleSide,
  });

  constructor() {
    const index: number[] = [];
    for (let track = 0; track < MOST; track++) {
      for (let i = 0; i < PIECES; i++) {
        const a = 2 * (track * (PIECES + 1) + i);
        index.push(a, a + 1, a + 2, a + 2, a + 1, a + 3);
      }
    }
    this.position.setUsage(DynamicDrawUsage);
    this.mesh = new Mesh(new BufferGeometry().setAttribute("position", this.position).setIndex(index), this.material);
    this.mesh.frustumCulled = false;
    this.mesh.renderOrder = 1;
  }

  /** holes: of each membrane. */
  update(
    field: Field,
    cut: Cut,
    holes: readonly (readonly Hole[])[],
    layers: readonly Layer[],
    diameter: number,
    window: Window,
  ): void {
    const out = this.position.array;
    const spot = { track: 0, u: 0, down: 0 };
    let track = 0;
    for (const layer of layers) {
      for (const hole of layer.membrane === null ? [] : (holes[layer.membrane] ?? [])) {
        const { u, d } = cut.spot(hole.front);
        const away = hole.front.clone().sub(cut.origin).dot(cut.towards) - cut.w;
        if (track >= MOST || Math.abs(away) > NEAR || Math.abs(u - window.centre) > 0.97 * window.size) continue;
        const slope = hole.direction.dot(cut.along) / Math.max(0.15, hole.direction.dot(cut.down));
        for (let i = 0; i <= PIECES; i++) {
          const depth = layer.top + ((layer.bottom - layer.top) * i) / PIECES;
          const x = u + slope * (depth - d) + diameter / 2;
          field.at(depth, spot);
          const share = field.share(x - spot.track);
          const half = diameter * (0.1 + 0.14 * Math.sin((Math.PI * (i + 1)) / (PIECES + 2)));
          const at = 6 * (track * (PIECES + 1) + i);
          for (const side of [0, 1]) {
            out[at + 3 * side] = x + share * spot.u + (2 * side - 1) * half;
            out[at + 3 * side + 1] = depth + share * spot.down;
            out[at + 3 * side + 2] = cut.w + 0.03;
          }
        }
        track += 1;
      }
    }
    this.mesh.geometry.setDrawRange(0, track * PIECES * 6);
    this.position.needsUpdate = true;
  }

  dispose(): void {
    this.mesh.geometry.dispose();
    this.material.dispose();
  }
}
