import type { Layer } from "./layers.ts";

/** A point in the cut: u along the surface, d down, mm. */
export interface Spot {
  u: number;
  d: number;
}

/** A membrane that holds the needle. */
export interface Grip {
  readonly membrane: number;
  /** The proxy: the place of the undeformed tissue that the tip is at. */
  readonly proxy: Spot;
  /** Run of the needle's track along the surface per mm of depth. */
  readonly slope: number;
}

/** The drawn tissue moves by less than this, whatever a hand does with the tip, mm. */
const MOST_DOWN = 9;
const MOST_ALONG = 4;
/** The tissue keeps this part of its thickness wherever it is pressed together. */
const LEAST_LEFT = 0.15;
/** The steepest fall of the displacement ahead of the tip. */
const STEEPEST = 0.8;
const STEPS_AHEAD = 4;

/** The displacement of the tissue along the needle's track, at one depth. */
interface Knot {
  d: number;
  /** Where the track crosses this depth. */
  track: number;
  u: number;
  down: number;
}

/**
 * The displacement of drawn tissue round a needle. Each membrane that holds the needle moves with its proxy: the tissue
 * at the proxy is where the tip is (K06 (21)). Tissue that the tip has not pierced stays ahead of it. A lumen is
 * pressed flat before the wall behind it moves. The displacement is bounded, and layers never change their order.
 */
export class Field {
  private knots: Knot[] = [];
  private width = 2;
  private flat = 1;
  private bottom = 1;

  constructor(
    private readonly layers: readonly Layer[],
    private readonly diameter: number,
  ) {
    this.bottom = layers.at(-1)?.bottom ?? 1;
  }

  /** tip: where it is now. grips: the membranes that hold the needle, in any order. lean: cosine to the normal. */
  set(tip: Spot, grips: readonly Grip[], lean = 1): void {
    this.knots = [];
    this.flat = Math.max(0.35, Math.min(1, Math.abs(lean)));
    const placed = grips
      .map((grip) => ({ grip, layer: this.layers.find(({ membrane }) => membrane === grip.membrane) }))
      .filter((one): one is { grip: Grip; layer: Layer } => one.layer !== undefined)
      .sort((a, b) => a.layer.top - b.layer.top);
    for (const { grip, layer } of placed) {
      const through = grip.proxy.d >= layer.bottom;
      this.hold(tip, grip, layer, through);
      // The membranes behind an unpierced one have not been reached by the drawn tip.
      if (!through || grip === placed.at(-1)!.grip) {
        this.press(layer, grip);
        break;
      }
    }
    this.keepOrder();
    let largest = 0;
    for (const { u, down } of this.knots) largest = Math.max(largest, Math.hypot(u, down));
    const soft = placed.at(-1)?.layer;
    this.width = 1.9 * this.diameter + 0.45 * Math.min(6, soft ? soft.bottom - soft.top : 0) + 0.9 * largest;
  }

  /** The part of a membrane that the tip has pierced moves as one piece. */
  private hold(tip: Spot, { proxy, slope }: Grip, layer: Layer, through: boolean): void {
    const end = through ? layer.bottom : Math.max(layer.top, proxy.d);
    const down = bounded(tip.d - proxy.d, Math.min(MOST_DOWN, (STEEPEST / 2) * (this.bottom - end)));
    const u = bounded(tip.u - proxy.u, MOST_ALONG);
    const margin = 0.12 * (end - layer.top);
    const add = (d: number): void => void this.knots.push({ d, track: proxy.u + slope * (d - proxy.d), u, down });
    if (margin > 1e-3) add(layer.top + margin);
    add(through ? end - margin : end);
  }

  /** The tissue behind the last membrane that holds the needle moves too, less with the distance; a fluid first. */
  private press(layer: Layer, { proxy, slope }: Grip): void {
    let { d, down, u } = this.knots.at(-1)!;
    const wide = 1.2 * this.diameter + 0.2 * Math.min(6, layer.bottom - layer.top);
    const put = (): void => void this.knots.push({ d, track: proxy.u + slope * (d - proxy.d), u, down });
    const ramp = (): number => Math.min(this.bottom - d, Math.max(3 * wide, (2 / STEEPEST) * Math.abs(down)));
    let start = { d, down, u };
    let length = ramp();
    for (const next of this.layers) {
      if (next.bottom <= d) continue;
      if (next.fill === "blood") {
        const taken = Math.min(Math.abs(down), (1 - LEAST_LEFT) * (next.bottom - d));
        u *= Math.abs(down) > 1e-9 ? 1 - taken / Math.abs(down) : 0;
        down -= Math.sign(down) * taken;
        d = next.bottom;
        put();
        start = { d, down, u };
        length = ramp();
        continue;
      }
      const first = d;
      const end = Math.min(next.bottom, start.d + length);
      for (let i = 1; i <= STEPS_AHEAD; i++) {
        d = first + ((end - first) * i) / STEPS_AHEAD;
        const left = (1 - (d - start.d) / length) ** 2;
        down = start.down * left;
        u = start.u * left;
        put();
      }
      if (end < next.bottom) return;
    }
  }

  /** Membranes follow their own proxies; where these would pass each other, the upper one is held back. */
  private keepOrder(): void {
    const { knots } = this;
    for (let i = knots.length - 2; i >= 0; i--) {
      const below = knots[i + 1]!;
      const here = knots[i]!;
      here.down = Math.min(here.down, below.down + (1 - LEAST_LEFT) * (below.d - here.d));
    }
  }

  /** Half the width of the dent, mm. */
  get reach(): number {
    return this.width / this.flat;
  }

  /** The displacement on the needle's track at depth d, and the track's place there. */
  at(d: number, out: { track: number; u: number; down: number }): typeof out {
    const { knots } = this;
    const first = knots[0];
    if (!first) {
      out.u = out.down = out.track = 0;
      return out;
    }
    let i = 0;
    while (i < knots.length && knots[i]!.d < d) i++;
    const above = knots[i - 1] ?? first;
    const below = knots[i] ?? knots.at(-1)!;
    const part = below.d > above.d ? (d - above.d) / (below.d - above.d) : 0;
    out.u = above.u + part * (below.u - above.u);
    out.down = above.down + part * (below.down - above.down);
    const slope = this.slopeAt(i);
    out.track =
      i === 0 || i === knots.length ? above.track + slope * (d - above.d) : mix(above.track, below.track, part);
    return out;
  }

  /** Slope of the track above the first knot and below the last one. */
  private slopeAt(i: number): number {
    const { knots } = this;
    const [a, b] = i === 0 ? [knots[0]!, knots[1]] : [knots.at(-2), knots.at(-1)!];
    return a && b && b.d > a.d ? (b.track - a.track) / (b.d - a.d) : 0;
  }

  /** The share of the track's displacement at a distance from it, mm: 1 at the needle, 0 far away. */
  share(distance: number): number {
    const r = (distance * this.flat) / this.width;
    return (1 + r * r) ** -1.5;
  }
}

const mix = (a: number, b: number, part: number): number => a + part * (b - a);

/** x, bent so that it never passes +-most. Small values stay as they are. */
export function bounded(x: number, most: number): number {
  if (!(most > 0)) return 0;
  const free = 0.6 * most;
  const over = Math.abs(x) - free;
  return over <= 0 ? x : Math.sign(x) * (free + (most - free) * Math.tanh(over / (most - free)));
}
