import { type Camera, Vector3 } from "three";
import type { Hand } from "../hand/hand.ts";
import type { Thumb } from "../hand/thumb.ts";
import { alongNeedle } from "./along.ts";
import type { OrbitCamera } from "./camera.ts";
import type { GestureHandler } from "./gestures.ts";
import { MM } from "./moment.ts";
import type { Stage } from "./stage.ts";
import type { World } from "./world.ts";

type Pixels = readonly [x: number, y: number];

/**
 * Turns gestures into moves of the hand and the camera. The hand keeps its offset to the pointer. free: whether a drag
 * moves sideways without Shift: along the surface of the first membrane, not in.
 */
export function needleGrip(
  hand: Hand,
  orbit: OrbitCamera,
  world: World,
  stage: Stage,
  free: () => boolean,
  thumb: Thumb,
): GestureHandler {
  const start = new Vector3(); // of the hand, mm
  const offset = new Vector3();
  const axis = new Vector3();
  const normal = new Vector3();
  let sideways = false;
  let from: Pixels = [0, 0];
  let inward: Pixels = [0, 0];
  let pixel = 1;
  let size: Pixels = [1, 1]; // of the view, when the needle was grabbed
  /** The place under the pointer. A view that has become larger or smaller since the grab does not move it. */
  const at = (x: number, y: number): Vector3 | null => {
    const [width, height] = size;
    const now = (height * stage.width) / stage.height; // the camera's angle is that of the height
    return orbit.onPlane(start, normal, x + (now - width) / 2, y, now, height);
  };
  const onScreen = (point: Vector3, camera: Camera): Pixels => {
    const { x, y } = point.clone().project(camera);
    return [((x + 1) / 2) * stage.width, ((1 - y) / 2) * stage.height];
  };
  return {
    grab(x, y, shift) {
      const pose = hand.grab();
      if (!pose) return false;
      start.set(...pose.position).multiplyScalar(MM);
      axis.set(...pose.axis).normalize();
      normal.set(...hand.normal()).normalize();
      sideways = shift || free();
      size = [stage.width, stage.height];
      const pointer = sideways ? at(x, y) : start;
      if (!pointer) return false;
      offset.subVectors(start, pointer);
      from = [x, y];
      const here = onScreen(start, orbit.camera);
      const deeper = onScreen(start.clone().add(axis), orbit.camera);
      inward = [deeper[0] - here[0], deeper[1] - here[1]];
      pixel = orbit.mmPerPixel(start, stage.height);
      hand.moveTo(pose.position);
      return true;
    },
    drag(x, y) {
      const to = sideways
        ? at(x, y)?.add(offset)
        : start.clone().addScaledVector(axis, alongNeedle([x - from[0], y - from[1]], inward, pixel));
      if (to) hand.moveTo([to.x / MM, to.y / MM, to.z / MM]);
    },
    release() {},
    orbit: (dx, dy) => orbit.orbit(dx, dy),
    pan: (dx, dy) => orbit.pan(dx, dy, stage.height),
    zoom: (factor) => orbit.zoom(factor),
    push(depth) {
      if (hand.barred.value || !world.extent) return false;
      hand.push(depth / MM);
      return true;
    },
    plunge: (pixels) => thumb.turn(pixels),
  };
}
