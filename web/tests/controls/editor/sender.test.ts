import { expect, test } from "vitest";
import { LastWins } from "../../../src/controls/editor/draft.ts";

test("only one request is pending at a time, and the newest waiting value is next", async () => {
  const sent: number[] = [];
  const told: [number, boolean][] = [];
  const answers: (() => void)[] = [];
  const sender = new LastWins<number, number>(
    (value) => {
      sent.push(value);
      return new Promise((resolve) => answers.push(() => resolve(value)));
    },
    (reply, _value, last) => told.push([reply, last]),
  );
  for (const value of [1, 2, 3, 4]) sender.give(value);
  expect(sent).toEqual([1]);
  answers[0]!();
  await new Promise((done) => setTimeout(done));
  expect(sent).toEqual([1, 4]);
  answers[1]!();
  await new Promise((done) => setTimeout(done));
  expect(told).toEqual([
    [1, false],
    [4, true],
  ]);
  expect(sender.busy).toBe(false);
  sender.give(5);
  expect(sent).toEqual([1, 4, 5]);
});
