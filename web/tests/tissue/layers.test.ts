import { expect, it } from "vitest";
import { asTissue, layersOf } from "../../src/tissue/layers.ts";
import type { MembraneView, SceneView } from "../../src/wire/messages.ts";

const scene = (...looks: MembraneView["look"][]): SceneView =>
  ({
    membranes: looks.map((look, i) => ({
      look,
      behind: "tissue",
      point: [0, -0.005 * i, 0],
      inward_normal: [0, -1, 0],
      thickness: 0.0001,
    })),
  }) as unknown as SceneView;

it("the stage draws sheets as tissue, and leaves tissue as it is", () => {
  const sheets = scene("plain", "plain");
  expect(layersOf(sheets)).toBeNull();
  expect(layersOf(asTissue(sheets))?.map(({ fill }) => fill)).toEqual(["fascia", "tissue", "fascia", "tissue"]);
  expect(asTissue(sheets)).toBe(asTissue(sheets)); // a new object is a new scene
  const vein = scene("skin", "plain");
  expect(asTissue(vein)).toBe(vein);
});
