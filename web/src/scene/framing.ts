import type { Triple } from "../engine/engine.ts";
import { onePerApp } from "../state/app.ts";
import { Signal } from "../state/signal.ts";

/** The part of the view that nothing covers, as shares of its width and height from the upper left corner. */
export interface Free {
  readonly left: number;
  readonly right: number;
  readonly top: number;
  readonly bottom: number;
}

/** Whether something stands to the right of the free part. */
export const isBeside = ({ right }: Free): boolean => right < 0.9;

/** Heights on the screen of depths below the skin, px from the view's upper border. */
export class DepthScale {
  private readonly bend: number;

  /** zero, half, whole: the heights of the depths 0, deep / 2 and deep. mm. */
  constructor(
    private readonly zero: number,
    half: number,
    private readonly whole: number,
    readonly deep: number,
  ) {
    // A straight line in space is a projective scale on the screen, which three of its points define.
    this.bend = (zero + whole - 2 * half) / (half - whole);
  }

  px(depth: number): number {
    const share = depth / this.deep;
    return (this.zero + share * (this.whole * (1 + this.bend) - this.zero)) / (1 + share * this.bend);
  }

  equals(other: DepthScale | null): boolean {
    const same = (depth: number): boolean => other !== null && Math.abs(this.px(depth) - other.px(depth)) < 0.5;
    return this.deep === other?.deep && same(0) && same(this.deep);
  }
}

/** What the stage and the view tell each other. */
export class Framing {
  /** Where the view keeps tissue, needle and syringe; null: its presets choose, as on the bench. */
  readonly free = new Signal<Free | null>(null);
  /** Counts how often the view shall go back to its first picture. */
  readonly again = new Signal(0);
  /** Where the view shows a point (m), px; set by the view. */
  onScreen: (point: Triple) => readonly [x: number, y: number] = () => [Number.NaN, Number.NaN];
  /** null while the view does not show depths one below the other. */
  readonly depths = new Signal<DepthScale | null>(null);
}

export const framingOf = onePerApp(() => new Framing());
