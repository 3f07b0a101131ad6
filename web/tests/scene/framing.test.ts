import { Vector3 } from "three";
import { expect, it, vi } from "vitest";
import { OrbitCamera } from "../../src/scene/camera.ts";
import { DepthScale } from "../../src/scene/framing.ts";

vi.stubGlobal("matchMedia", () => ({ matches: true }));

const FREE = { left: 0.05, right: 0.6, top: 0.2, bottom: 0.9 };

it.each([0.4, 1, 2.4])("all points are in the free part of the view, and fill it: aspect %f", (aspect) => {
  const points = [-1, 1].flatMap((x) => [-3, 7].flatMap((y) => [-2, 2].map((z) => new Vector3(10 * x, 4 * y, 6 * z))));
  const camera = new OrbitCamera();
  camera.resize(1000 * aspect, 1000);
  camera.frame(new Vector3(), 20);
  camera.preset("front", new Vector3(0, -1, 0), new Vector3());
  camera.enclose(points, FREE);
  camera.step(0);
  const seen = points.map((point) => point.clone().project(camera.camera));
  const xs = seen.map(({ x }) => (1 + x) / 2);
  const ys = seen.map(({ y }) => (1 - y) / 2);
  const [left, right, top, bottom] = [Math.min(...xs), Math.max(...xs), Math.min(...ys), Math.max(...ys)];
  expect(left).toBeGreaterThan(FREE.left - 1e-3);
  expect(right).toBeLessThan(FREE.right + 1e-3);
  expect(top).toBeGreaterThan(FREE.top - 1e-3);
  expect(bottom).toBeLessThan(FREE.bottom + 1e-3);
  const fills = [(right - left) / (FREE.right - FREE.left), (bottom - top) / (FREE.bottom - FREE.top)];
  expect(Math.max(...fills)).toBeGreaterThan(0.97);
  expect(right).toBeGreaterThan(FREE.right - 1e-2); // beside the curve
});

it("a scale of depths is exact for a line in perspective", () => {
  const seen = (depth: number): number => (100 + 7 * depth) / (1 + 0.004 * depth);
  const scale = new DepthScale(seen(0), seen(10), seen(20), 20);
  for (const depth of [-3, 0, 4, 11, 20, 25]) expect(scale.px(depth)).toBeCloseTo(seen(depth), 6);
});
