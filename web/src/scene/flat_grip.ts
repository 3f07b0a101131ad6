import { Vector3 } from "three";
import type { Hand } from "../hand/hand.ts";
import type { Thumb } from "../hand/thumb.ts";
import { add, scaled } from "../hand/vectors.ts";
import type { App } from "../state/app.ts";
import { alongNeedle } from "./along.ts";
import type { GestureHandler } from "./gestures.ts";
import { MM } from "./moment.ts";
import { type Probe, planeOf, skinFrame } from "./probe.ts";

const WITHOUT_A_PICTURE = 0.1; // mm per pixel

/**
 * Without the 3-D view, a drag moves the needle in the slice's plane: along its own line as the slice shows it, or, if
 * `sideways`, along the skin. width: of the picture, px.
 */
export function flatGrip(app: App, hand: Hand, probe: Probe, thumb: Thumb, width: () => number): GestureHandler {
  let drag: (dx: number, dy: number) => void = () => {};
  let from: readonly [x: number, y: number] = [0, 0];
  return {
    grab(x, y, sideways) {
      const pose = hand.grab();
      const scene = app.live.scene.value;
      if (!pose || !scene) return false;
      const { along, inward } = planeOf(skinFrame(scene), probe.place.value);
      const pixel = (probe.picture.value?.width ?? WITHOUT_A_PICTURE * width()) / width();
      const axis = new Vector3(...pose.axis);
      const way = [axis.dot(along) / pixel, axis.dot(inward) / pixel] as const;
      from = [x, y];
      drag = (dx, dy) => {
        const step = sideways
          ? scaled([along.x, along.y, along.z], (dx * pixel) / MM)
          : scaled(pose.axis, alongNeedle([dx, dy], way, pixel) / MM);
        hand.moveTo(add(pose.position, step));
      };
      hand.moveTo(pose.position);
      return true;
    },
    drag: (x, y) => drag(x - from[0], y - from[1]),
    release() {},
    orbit() {},
    pan() {},
    zoom() {},
    push(depth) {
      if (hand.barred.value) return false;
      hand.push(depth / MM);
      return true;
    },
    plunge: (pixels) => thumb.turn(pixels),
  };
}
