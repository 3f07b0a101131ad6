import { PerspectiveCamera, Vector3 } from "three";
import { expect, it } from "vitest";
import { outOfView } from "../../src/scene/out_of_view.ts";

const camera = new PerspectiveCamera(90, 1, 1, 100);
camera.position.set(0, 0, 10);
camera.lookAt(0, 0, 0);
camera.updateMatrixWorld();

it("a point is out of view beyond the border and behind the camera", () => {
  expect(outOfView(new Vector3(0, 0, 0), camera)).toBe(false);
  expect(outOfView(new Vector3(9.8, 0, 0), camera)).toBe(true);
  expect(outOfView(new Vector3(0, -9.8, 0), camera)).toBe(true);
  expect(outOfView(new Vector3(0, 0, 20), camera)).toBe(true);
});

it("a point under the toolbar is out of view", () => {
  const high = new Vector3(0, 5, 0); // a quarter of the height from the upper border
  expect(outOfView(high, camera, 0.2)).toBe(false);
  expect(outOfView(high, camera, 0.24)).toBe(true); // half of what is around it is under the toolbar
  expect(outOfView(high, camera, 0.3)).toBe(true);
});
