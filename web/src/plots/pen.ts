import type { Polyline } from "./polyline.ts";

export interface Stroke {
  readonly colour: string;
  readonly width: number;
  readonly alpha?: number;
  readonly dash?: readonly number[];
}
export interface Lettering {
  readonly colour: string;
  /** px */
  readonly size?: number;
  readonly anchor?: "start" | "middle" | "end";
  readonly bold?: boolean;
  /** A rim in this colour, so that the text can be read on lines. */
  readonly halo?: string;
}

/**
 * What a plot draws with: a canvas on the screen, or an SVG file. One drawing serves both, so that what is saved is
 * what was
 * seen. Lengths are CSS pixels from the top left; text stands with its middle at y.
 */
export interface Pen {
  line(points: Polyline, stroke: Stroke): void;
  /** The area inside the points. */
  area(points: Polyline, colour: string, alpha: number): void;
  segment(x1: number, y1: number, x2: number, y2: number, stroke: Stroke): void;
  box(x: number, y: number, width: number, height: number, colour: string, alpha: number): void;
  dot(x: number, y: number, radius: number, fill: string, rim: string): void;
  text(x: number, y: number, text: string, lettering: Lettering): void;
  /** Everything that `draw` draws ends at the edges of this box. */
  within(x: number, y: number, width: number, height: number, draw: () => void): void;
}

export const FONT = 'system-ui, "Segoe UI", "DejaVu Sans", sans-serif';
