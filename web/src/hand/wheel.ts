const MM_PER_PIXEL = 0.004;

export const wheelPixels = ({ deltaMode, deltaY }: WheelEvent): number => (deltaMode === 1 ? deltaY * 18 : deltaY);

/** How far the wheel moves the needle along its line, mm; positive goes in. */
export const wheelDepth = (event: WheelEvent): number => wheelPixels(event) * MM_PER_PIXEL;
