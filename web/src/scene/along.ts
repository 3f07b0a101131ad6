type Pixels = readonly [x: number, y: number];

/** Below this share of its true length, the needle's line on the screen is too short to drag along. */
const SHORTEST = 0.2;

/**
 * How far a drag moves the needle along its own line, mm; positive is inward. drag: pixels, y downwards. inward: where
 * a point 1 mm further in is on the screen, in pixels. pixel: the size of a pixel at the needle, mm. If the camera
 * looks along the needle, a drag down is inward.
 */
export function alongNeedle([dx, dy]: Pixels, [ix, iy]: Pixels, pixel: number): number {
  const square = ix * ix + iy * iy;
  if (Math.sqrt(square) * pixel < SHORTEST) return dy * pixel;
  return (dx * ix + dy * iy) / square;
}
