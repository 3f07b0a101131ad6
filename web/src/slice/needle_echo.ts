import type { InPicture, NeedleSpan } from "./needle_span.ts";

/** Distance between the repeated echoes, in needle diameters, and the brightness of each against the last. */
const GAP = 1.1;
const REPEATS = 4;
const WEAKER = 0.42;
const SOFT = [2.2, 1.9, 1.6, 1.3, 1, 0.7] as const;
const SOFT_SHARE = 0.14;

/** From a place in the picture to pixels. */
export interface ToPixels {
  /** Pixels per mm. */
  readonly scale: number;
  x(along: number): number;
  y(depth: number): number;
}

/**
 * Draws the needle's bright echo and, below it, the echoes that repeat between its walls. facing: share of the needle's
 * direction across the beam; a needle along the beam reflects little to the probe. diameter: mm.
 */
export function drawNeedle(
  draw: CanvasRenderingContext2D,
  span: NeedleSpan,
  to: ToPixels,
  diameter: number,
  facing: number,
): void {
  const bright = (0.35 + 0.65 * facing) * (1 - 0.75 * span.off ** 2);
  const thick = Math.max(1.5, 0.5 * diameter * to.scale);
  draw.save();
  draw.globalCompositeOperation = "lighter";
  draw.lineCap = "round";
  for (let echo = REPEATS; echo >= 0; echo--) {
    const below = echo * GAP * diameter;
    const strength = bright * WEAKER ** echo;
    // Several strokes on each other make a soft border.
    for (const part of SOFT) stroke(draw, span, to, below, part * thick, SOFT_SHARE * strength);
    if (echo === 0) stroke(draw, span, to, 0, 0.6 * thick, 0.6 * strength);
  }
  if (span.tip) point(draw, span.deep, to, thick, bright);
  draw.restore();
}

function stroke(
  draw: CanvasRenderingContext2D,
  { deep, shallow }: NeedleSpan,
  to: ToPixels,
  below: number,
  width: number,
  strength: number,
): void {
  draw.strokeStyle = `rgba(255, 255, 255, ${strength.toFixed(3)})`;
  draw.lineWidth = width;
  draw.beginPath();
  draw.moveTo(to.x(deep.along), to.y(deep.depth + below));
  draw.lineTo(to.x(shallow.along), to.y(shallow.depth + below));
  draw.stroke();
}

/** The slanted face of the tip sends more sound back than the shaft. */
function point(draw: CanvasRenderingContext2D, at: InPicture, to: ToPixels, thick: number, bright: number): void {
  draw.fillStyle = `rgba(255, 255, 255, ${(0.9 * bright).toFixed(3)})`;
  draw.beginPath();
  draw.arc(to.x(at.along), to.y(at.depth), 0.9 * thick, 0, 2 * Math.PI);
  draw.fill();
}
