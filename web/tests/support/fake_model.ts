import type { LawCurve, SceneView } from "../../src/wire/messages.ts";

/** One thin membrane under a needle along -y: K06 (13), (14), and a spring as coupling. For tests of the page only. */
export class FakeMembrane {
  readonly tipLength: number;
  readonly growthIn: number;
  readonly growthOut: number;
  readonly bias: number;
  readonly shaft: number;
  /** Where the proxy is along the depth, m. */
  q = -1;
  force = 0;
  phase = 0;

  constructor(
    readonly name: string,
    readonly place: number,
    readonly thickness: number,
    readonly stiffness: number,
    precompression: number,
    friction: number,
  ) {
    const t = Math.tan((11 * Math.PI) / 180);
    const diameter = 0.82e-3;
    this.tipLength = diameter / t;
    this.growthIn = (stiffness * t * (2 * friction + (1 - friction ** 2) * t)) / (1 - friction * t);
    this.growthOut = (stiffness * t * (2 * friction - (1 - friction ** 2) * t)) / (1 + friction * t);
    this.bias = precompression / (stiffness * t);
    this.shaft = 2 * friction * (stiffness * diameter + precompression);
  }

  lower(q: number): number {
    return q <= 0 ? 0 : q > this.tipLength ? -this.shaft : -this.growthIn * (q + this.bias);
  }
  upper(q: number): number {
    return q <= 0 ? 0 : q > this.tipLength ? this.shaft : this.growthOut * (q + this.bias);
  }

  /** The tip at depth p (m): the proxy sticks, or slides to where the coupling meets the band. */
  step(p: number): void {
    const K = 500;
    if (p <= 0 && this.q <= 0) {
      this.q = p;
      this.force = 0;
      this.phase = 0;
      return;
    }
    this.q = Math.max(this.q, 0);
    const fine = 2e-6;
    let moved = 0;
    while (K * (this.q - p) < this.lower(this.q + fine)) {
      this.q += fine;
      moved = 1;
    }
    while (this.q > 0 && K * (this.q - p) > this.upper(this.q)) {
      this.q -= fine;
      moved = -1;
    }
    this.force = K * (this.q - p);
    this.phase = this.q <= 0 ? 0 : moved === 0 ? 1 : moved > 0 ? 2 : 3;
    if (this.q <= 0) this.force = 0;
  }

  law(): LawCurve {
    const depth = Array.from({ length: 120 }, (_, i) => (i / 119) * 1.6 * this.tipLength);
    return {
      name: this.name,
      obliquity: 0,
      far_face: this.thickness,
      through: this.tipLength + this.thickness,
      depth,
      lower: depth.map((q) => this.lower(q)),
      upper: depth.map((q) => this.upper(q)),
    };
  }
}

export const fakeMembranes = (stiffer = 1): FakeMembrane[] => [
  new FakeMembrane("skin", 0, 1.2e-3, 900 * stiffer, 0.5, 0.1),
  new FakeMembrane("front vein wall", 4.81e-3, 0.4e-3, 450 * stiffer, 0.25, 0.08),
  new FakeMembrane("back vein wall", 8.22e-3, 0.4e-3, 450 * stiffer, 0.25, 0.08),
];

export function fakeScene(membranes: readonly FakeMembrane[]): SceneView {
  return {
    number: 1,
    name: "Venipuncture",
    diameter: 0.82e-3,
    tip_length: 0.82e-3 / Math.tan((11 * Math.PI) / 180),
    direction: "stylus",
    solver: "exact",
    rate: 1600,
    force_scale: 1,
    syringe: null,
    membranes: membranes.map((m, i) => ({
      name: m.name,
      point: [0, -m.place, 0],
      inward_normal: [0, -1, 0],
      thickness: m.thickness,
      look: "plain",
      behind: i === 1 ? "blood" : "tissue",
    })),
    laws: membranes.map((m) => m.law()),
    tables: {},
    lumen: [1, 2],
  };
}
