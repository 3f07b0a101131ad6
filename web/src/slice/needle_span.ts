import type { Vector3 } from "three";
import type { SlicePlane } from "../scene/probe.ts";

/** Thickness of the slice, mm: illustrative. */
export const BEAM = 1;

const ALONG = Math.sin(Math.PI / 12); // a needle within 15 degrees of the slice lies along it

/** A place in the picture, mm: along the probe from its middle, and below the skin. */
export interface InPicture {
  readonly along: number;
  readonly depth: number;
}

/** The part of the needle that the slice shows. */
export interface NeedleSpan {
  /** The end nearer to the tip. */
  readonly deep: InPicture;
  readonly shallow: InPicture;
  /** Whether the tip itself is in the slice. */
  readonly tip: boolean;
  /** Share of the slice's thickness that the needle is away from its middle: 0 is bright, 1 is invisible. */
  readonly off: number;
  /** Whether the needle lies along the slice, rather than crosses it. */
  readonly along: boolean;
}

/**
 * The part of a needle that lies within the slice's thickness and below the skin; null if there is none. In plane it is
 * a line, out of plane a dot. Lengths in mm.
 */
export function needleSpan(
  plane: SlicePlane,
  tip: Vector3,
  axis: Vector3,
  length: number,
  radius: number,
): NeedleSpan | null {
  const from = tip.clone().sub(plane.origin);
  const at = (direction: Vector3): readonly [number, number] => [from.dot(direction), -axis.dot(direction)];
  const [out, outward] = at(plane.out);
  const [along, alongward] = at(plane.along);
  const [depth, upward] = at(plane.inward);
  const half = BEAM / 2 + radius;
  let first = 0; // distances from the tip along the shaft
  let last = length;
  const keep = (value: number, slope: number, least: number): void => {
    // Keeps the part with value + slope t >= least.
    if (Math.abs(slope) < 1e-9) last = value >= least ? last : -1;
    else if (slope > 0) first = Math.max(first, (least - value) / slope);
    else last = Math.min(last, (least - value) / slope);
  };
  keep(out, outward, -half);
  keep(-out, -outward, -half);
  keep(depth, upward, 0);
  if (!(first <= last)) return null;
  const place = (t: number): InPicture => ({ along: along + t * alongward, depth: depth + t * upward });
  const nearest = Math.abs(outward) < 1e-9 ? first : Math.min(last, Math.max(first, -out / outward));
  return {
    deep: place(first),
    shallow: place(last),
    tip: first === 0,
    off: Math.min(1, Math.abs(out + nearest * outward) / half),
    along: Math.abs(outward) < ALONG,
  };
}
