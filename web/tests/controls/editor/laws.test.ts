import { expect, test } from "vitest";
import { felt } from "../../../src/controls/editor/laws.ts";
import scene from "../support/scene.json";

test("insertion friction is above: the hand feels the opposite of the needle's force", () => {
  const law = felt(scene.laws[0]!);
  expect(Math.max(...law.upper)).toBe(-Math.min(...scene.laws[0]!.lower));
  expect(law.upper.every((force, i) => force >= law.lower[i]!)).toBe(true);
});
