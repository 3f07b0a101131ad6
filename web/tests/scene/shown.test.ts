import { expect, it } from "vitest";
import { Shown } from "../../src/scene/shown.ts";

it("a trembling value needs no new picture, a drifting one does, and so does another number of values", () => {
  const shown = new Shown();
  expect(shown.differs([10.4, 3])).toBe(true);
  for (const value of [10.6, 9.5, 11.3, 10.4]) expect(shown.differs([value, 3])).toBe(false);
  expect(shown.differs([11.4, 3])).toBe(true);
  expect(shown.differs([10.6, 3])).toBe(false);
  expect(shown.differs([10.6, 3, 0])).toBe(true);
  shown.forget();
  expect(shown.differs([10.6, 3, 0])).toBe(true);
});
