import { wheelDepth, wheelPixels } from "../hand/wheel.ts";

/** Actions of a pointer over the view. Positions: CSS pixels from the view's upper left corner as a gesture begins. */
export interface GestureHandler {
  /**
   * The following drags move the needle along its own line, or in a plane if `sideways`. Returns false if the needle
   * cannot be grabbed; the gesture then orbits the scene.
   */
  grab(x: number, y: number, sideways: boolean): boolean;
  drag(x: number, y: number): void;
  release(): void;
  orbit(dx: number, dy: number): void;
  pan(dx: number, dy: number): void;
  zoom(factor: number): void;
  /** Moves along the needle, mm; positive goes in. Returns false if the needle cannot be moved. */
  push(depth: number): boolean;
  /** The wheel, turned by so many pixels, pushes the syringe's plunger; turned back, it lets go. */
  plunge(pixels: number): void;
}

type Mode = "none" | "needle" | "orbit" | "pan" | "pinch";

/**
 * One finger or the left button moves the needle along its line; with Shift, also sideways. The right button or two
 * fingers orbit the scene. The wheel moves the needle along its line; with Alt it pushes the syringe's plunger.
 */
export function gestures(canvas: HTMLElement, handler: GestureHandler): { cancel(): void } {
  const pointers = new Map<number, { x: number; y: number }>();
  let mode: Mode = "none";

  // The view's corner when a gesture begins. The page can move the view during a gesture, but not what it holds.
  let corner = { x: 0, y: 0 };

  const at = ({ clientX, clientY }: PointerEvent): { x: number; y: number } => ({
    x: clientX - corner.x,
    y: clientY - corner.y,
  });
  const enter = (next: Mode): void => {
    if (mode === "needle" && next !== "needle") handler.release();
    mode = next;
    canvas.dataset.gesture = next;
  };

  canvas.addEventListener("pointerdown", (event) => {
    if (pointers.size === 0) {
      const { left, top } = canvas.getBoundingClientRect();
      corner = { x: left, y: top };
    }
    const point = at(event);
    pointers.set(event.pointerId, point);
    canvas.setPointerCapture(event.pointerId);
    if (pointers.size === 2) enter("pinch");
    else if (pointers.size > 2) enter("none");
    else if (event.button === 1) enter("pan");
    else if (event.button === 2) enter("orbit");
    else enter(handler.grab(point.x, point.y, event.shiftKey) ? "needle" : "orbit");
    if (event.button === 1) event.preventDefault();
  });

  canvas.addEventListener("pointermove", (event) => {
    const before = pointers.get(event.pointerId);
    if (!before) return;
    const point = at(event);
    const dx = point.x - before.x;
    const dy = point.y - before.y;
    if (mode === "needle") handler.drag(point.x, point.y);
    else if (mode === "orbit") handler.orbit(dx, dy);
    else if (mode === "pan") handler.pan(dx, dy);
    else if (mode === "pinch") {
      const other = [...pointers].find(([id]) => id !== event.pointerId)?.[1];
      if (other) {
        const apart = Math.hypot(point.x - other.x, point.y - other.y);
        const was = Math.hypot(before.x - other.x, before.y - other.y);
        if (was > 10 && apart > 10) handler.zoom(apart / was);
        handler.orbit(dx / 2, dy / 2);
      }
    }
    pointers.set(event.pointerId, point);
  });

  const up = (event: PointerEvent): void => {
    if (!pointers.delete(event.pointerId)) return;
    // When one of two fingers is lifted, the other must not grab the needle.
    enter(pointers.size === 1 ? "orbit" : "none");
  };
  canvas.addEventListener("pointerup", up);
  canvas.addEventListener("pointercancel", up);
  canvas.addEventListener("contextmenu", (event) => event.preventDefault());
  canvas.addEventListener(
    "wheel",
    (event) => {
      event.preventDefault();
      const pixels = wheelPixels(event);
      if (event.altKey) handler.plunge(pixels);
      else if (event.ctrlKey || event.metaKey || !handler.push(wheelDepth(event))) {
        handler.zoom(Math.exp(-pixels * (event.ctrlKey ? 0.006 : 0.0012)));
      }
    },
    { passive: false },
  );

  return {
    /** Cancels the present gesture. Pressed pointers do nothing until they are released and pressed again. */
    cancel() {
      const held = [...pointers.keys()];
      pointers.clear(); // first: releasing a capture can call a listener
      for (const id of held) if (canvas.hasPointerCapture(id)) canvas.releasePointerCapture(id);
      enter("none");
    },
  };
}
