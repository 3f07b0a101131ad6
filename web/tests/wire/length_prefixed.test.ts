import { expect, test } from "vitest";
import { FrameSplitter } from "../../src/wire/length_prefixed.ts";
import { decodeTicks } from "../../src/wire/ticks.ts";
import { prefixed } from "../controls/support/prefixed.ts";
import { makeFrame } from "./frame.ts";

const stream = prefixed([
  makeFrame({ first: 0, count: 3, membranes: 1 }),
  makeFrame({ first: 3, count: 2, membranes: 1 }),
]);

test("frames are found however the stream is cut", () => {
  for (const size of [1, 7, 64, stream.byteLength]) {
    const splitter = new FrameSplitter();
    const frames: ArrayBuffer[] = [];
    for (let at = 0; at < stream.byteLength; at += size) frames.push(...splitter.push(stream.subarray(at, at + size)));
    splitter.end();
    expect(frames.map((frame) => decodeTicks(frame)).map(({ firstTick, count }) => [firstTick, count])).toEqual([
      [0, 3],
      [3, 2],
    ]);
  }
});

test("a stream that ends within a frame is told", () => {
  const splitter = new FrameSplitter();
  expect(splitter.push(stream.subarray(0, stream.byteLength - 4))).toHaveLength(1);
  expect(() => splitter.end()).toThrow("ends within a frame");
});

test("a length that cannot be is told", () => {
  expect(() => new FrameSplitter().push(new Uint8Array([255, 255, 255, 255]))).toThrow("cannot be");
  expect(() => new FrameSplitter().push(new Uint8Array([0, 0, 0, 0]))).toThrow("cannot be");
});
