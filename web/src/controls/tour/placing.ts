export interface Box {
  readonly left: number;
  readonly top: number;
  readonly width: number;
  readonly height: number;
}

const GAP = 12;

/**
 * The place of a popover of this size: right, left, below or above the box, the first that has space; else inside the
 * box's lower right corner. Always within the window.
 */
export function placed(
  box: Box,
  size: Pick<Box, "width" | "height">,
  window: Pick<Box, "width" | "height">,
): { left: number; top: number; side: "right" | "left" | "below" | "above" | "inside" } {
  const right = box.left + box.width;
  const bottom = box.top + box.height;
  const across = clamp(box.left + (box.width - size.width) / 2, window.width - size.width);
  const down = clamp(box.top + Math.min(48, (box.height - size.height) / 2), window.height - size.height);
  if (right + GAP + size.width + GAP <= window.width) return { left: right + GAP, top: down, side: "right" };
  if (box.left - GAP - size.width >= GAP) return { left: box.left - GAP - size.width, top: down, side: "left" };
  if (bottom + GAP + size.height + GAP <= window.height) return { left: across, top: bottom + GAP, side: "below" };
  if (box.top - GAP - size.height >= GAP) return { left: across, top: box.top - GAP - size.height, side: "above" };
  return {
    left: clamp(right - size.width - GAP, window.width - size.width),
    top: clamp(Math.min(bottom, window.height) - size.height - GAP, window.height - size.height),
    side: "inside",
  };
}

const clamp = (value: number, most: number): number => Math.max(GAP, Math.min(value, most - GAP));
