import { Vector3 } from "three";
import { beforeEach, describe, expect, it, vi } from "vitest";
import { OrbitCamera } from "../../src/scene/camera.ts";

const NORMAL = new Vector3(0, -1, 0);
const START = new Vector3(-13, 5, -4);
const SIZE = [800, 600] as const;

/** The moves of the needle, mm, for a drag to the right and for one down, seen from this preset. */
function drags(preset: "oblique" | "side" | "top"): Vector3[] {
  const orbit = new OrbitCamera();
  orbit.preset(preset, new Vector3(), new Vector3(0, -1, 0));
  orbit.settle();
  orbit.step(16);
  const at = (x: number, y: number) => orbit.onPlane(START, NORMAL, x, y, ...SIZE)!;
  return [at(410, 300).sub(at(400, 300)), at(400, 310).sub(at(400, 300))];
}

describe("a sideways drag", () => {
  beforeEach(() => {
    vi.stubGlobal("matchMedia", () => ({ matches: true }));
    return () => vi.unstubAllGlobals();
  });

  it("never moves the needle in, from wherever it is seen", () => {
    for (const preset of ["oblique", "side", "top"] as const)
      for (const move of drags(preset)) expect(Math.abs(move.y)).toBeLessThan(1e-9);
  });

  it("moves towards the user when it goes down, and to the right", () => {
    for (const preset of ["oblique", "top"] as const) {
      const [right, down] = drags(preset);
      expect(right!.x).toBeGreaterThan(0.05);
      expect(down!.z).toBeGreaterThan(0.05);
    }
  });
});
