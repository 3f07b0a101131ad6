import { Vector3 } from "three";
import type { Hand } from "../hand/hand.ts";
import type { OrbitCamera } from "./camera.ts";
import type { GestureHandler } from "./gestures.ts";
import { MM } from "./moment.ts";
import type { Stage } from "./stage.ts";
import type { World } from "./world.ts";

/** Turns gestures into moves of the hand and the camera. The hand keeps its offset to the pointer. */
export function needleGrip(hand: Hand, orbit: OrbitCamera, world: World, stage: Stage): GestureHandler {
  const plane = new Vector3();
  const offset = new Vector3();
  const axis = new Vector3();
  const at = (x: number, y: number): Vector3 | null => orbit.inPlaneOf(plane, axis, x, y, stage.width, stage.height);
  return {
    grab(x, y) {
      const pose = hand.barred.value ? null : hand.pose();
      if (!pose) return false;
      plane.set(...pose.position).multiplyScalar(MM);
      axis.set(...pose.axis).normalize();
      const pointer = at(x, y);
      if (!pointer) return false;
      offset.subVectors(plane, pointer);
      hand.moveTo(pose.position);
      return true;
    },
    drag(x, y) {
      const to = at(x, y)?.add(offset).divideScalar(MM);
      if (to) hand.moveTo([to.x, to.y, to.z]);
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
  };
}
