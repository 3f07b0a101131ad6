import { Vector3 } from "three";
import { Cut } from "../scene/cut.ts";
import { gripsOf } from "../scene/grips.ts";
import type { Moment } from "../scene/moment.ts";
import type { SkinFrame } from "../scene/probe.ts";
import { Field } from "../tissue/field.ts";
import type { Tissue } from "./layers.ts";

const STEP = 0.05; // mm between two depths of the tables
const SMALLEST = 0.005; // mm
const VIEWER = new Vector3(0, 0, 1e6); // the slice is the same from everywhere

/** The displacement of the tissue by the needle: on the needle's track, by the undeformed depth, and its width. mm. */
export interface Dents {
  readonly step: number;
  /** Where the track is along the cut, and how far the tissue there is moved along the cut and down. */
  readonly track: Float32Array;
  readonly along: Float32Array;
  readonly down: Float32Array;
  /** Half the width of the dent. */
  readonly reach: number;
  /** The largest displacement. */
  readonly most: number;
  /** The plane that contains the needle, and the place along `towards` of the needle and of a vessel. */
  readonly cut: Cut;
  readonly needle: number;
}

/** Computes the dents with the field that bends the 3-D view's tissue. */
export class Denter {
  private readonly cut = new Cut();
  private readonly field: Field;
  private readonly track: Float32Array;
  private readonly along: Float32Array;
  private readonly down: Float32Array;

  /** depth: of the picture; diameter: of the needle, mm. */
  constructor(skin: SkinFrame, tissue: Tissue, depth: number, diameter: number) {
    this.cut.build(skin.origin, skin.inward);
    this.field = new Field(tissue.parallel, diameter);
    const count = Math.ceil(depth / STEP) + 1;
    this.track = new Float32Array(count);
    this.along = new Float32Array(count);
    this.down = new Float32Array(count);
  }

  at(moment: Moment): Dents {
    const { cut, field, track, along, down } = this;
    cut.place(moment.tip, moment.axis, VIEWER, 1e6);
    field.set(cut.spot(moment.tip), gripsOf(moment, cut), moment.axis.dot(cut.down));
    const spot = { track: 0, u: 0, down: 0 };
    let most = 0;
    for (let i = 0; i < track.length; i++) {
      field.at(i * STEP, spot);
      track[i] = spot.track;
      along[i] = spot.u;
      down[i] = spot.down;
      most = Math.max(most, Math.hypot(spot.u, spot.down));
    }
    if (most < SMALLEST) most = 0;
    const needle = moment.tip.clone().sub(cut.origin).dot(cut.towards);
    return { step: STEP, track, along, down, reach: field.reach, most, cut, needle };
  }
}

/** Where a place on the needle's track is displaced to, by its undeformed depth, mm. */
export function displaced(depth: number, { down, step }: Dents): number {
  const i = Math.max(0, Math.min(down.length - 1, Math.round(depth / step)));
  return depth + down[i]!;
}
