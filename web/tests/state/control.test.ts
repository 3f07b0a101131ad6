import { expect, it } from "vitest";
import { withoutControl } from "../../src/state/control.ts";

it("says whether another page has control, or none", () => {
  expect(withoutControl({ holder: 2 })).toBe("Another page has control");
  expect(withoutControl({ holder: null })).toBe("No page has control");
});
