import { expect, it } from "vitest";
import { Field } from "../../src/tissue/field.ts";
import { bendRow, COLUMNS } from "../../src/tissue/grid.ts";
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

it("what the tissue has more at its ends is at rest, and changes nothing else", () => {
  const field = new Field([], 1);
  const row = (left: number, right: number): number[] => {
    const [rest, moved] = [new Float32Array(2 * COLUMNS), new Float32Array(3 * COLUMNS)];
    bendRow(field, 1, 10, { centre: 2, size: 8, left, right }, rest, moved, 0);
    return [...moved];
  };
  const [narrow, wide] = [row(0, 0), row(24, 12)];
  expect(narrow.slice(0, 3)).toEqual([-6, 1, 0]);
  expect(wide.slice(0, 3)).toEqual([-30, 1, 0]);
  expect(wide.slice(-3)).toEqual([22, 1, 0]);
  expect(wide.slice(3, -3)).toEqual(narrow.slice(3, -3));
});
