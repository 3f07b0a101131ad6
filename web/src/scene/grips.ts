import type { Grip } from "../tissue/field.ts";
import type { Cut } from "./cut.ts";
import { BARRED, type Moment, OUTSIDE } from "./moment.ts";

/** The membranes that hold the needle, in the coordinates of a cut. */
export function gripsOf(moment: Moment, cut: Cut): Grip[] {
  return moment.membranes.flatMap(({ phase, proxy, direction }, membrane) => {
    if (phase === OUTSIDE || phase === BARRED || direction.lengthSq() < 0.5) return [];
    const down = Math.max(0.15, direction.dot(cut.down));
    return [{ membrane, proxy: cut.spot(proxy), slope: direction.dot(cut.along) / down }];
  });
}
