import { expect, it } from "vitest";
import type { App } from "../../src/state/app.ts";
import { controlWords } from "../../src/state/control.ts";

it.each([
  [true, ["You move the needle", "Another page moves the needle", "Nobody moves the needle"]],
  [false, ["You have control", "Another page has control", "No page has control"]],
])("says who has control; of a simulated device (%s), who moves the needle", (simulated, words) => {
  const said = [
    { you: true, holder: 1 },
    { you: false, holder: 2 },
    { you: false, holder: null },
  ].map((value) => controlWords({ control: { value }, hello: { value: { device: { simulated } } } } as unknown as App));
  expect(said).toEqual(words);
});
