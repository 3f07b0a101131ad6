import type { Polyline } from "./polyline.ts";

export interface Stroke {
  readonly colour: string;
  readonly width: number;
  readonly alpha?: number;
  readonly dash?: readonly number[];
  /** px that dashes are ahead of x on the screen, so that they move with a line that is drawn piece by piece. */
  readonly phase?: number;
}
export interface Lettering {
  readonly colour: string;
  /** px */
  readonly size?: number;
  readonly anchor?: "start" | "middle" | "end";
  readonly bold?: boolean;
  /** Colour of an outline that keeps the text readable on top of lines. */
  readonly halo?: string;
}

/**
 * The drawing surface of a plot: a canvas on the screen or an SVG file. Both use the same drawing code, so the saved
 * picture equals the screen. Lengths are CSS pixels from the top left; text is centred vertically at y.
 */
export interface Pen {
  line(points: Polyline, stroke: Stroke): void;
  /** The area inside the points. */
  area(points: Polyline, colour: string, alpha: number): void;
  segment(x1: number, y1: number, x2: number, y2: number, stroke: Stroke): void;
  box(x: number, y: number, width: number, height: number, colour: string, alpha: number): void;
  dot(x: number, y: number, radius: number, fill: string, rim: string): void;
  text(x: number, y: number, text: string, lettering: Lettering): void;
  /** Clips everything that `draw` draws to this box. */
  within(x: number, y: number, width: number, height: number, draw: () => void): void;
}

export const FONT = 'system-ui, "Segoe UI", "DejaVu Sans", sans-serif';
