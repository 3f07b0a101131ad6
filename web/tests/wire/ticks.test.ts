import { describe, expect, it } from "vitest";
import type { ByteColumn, FloatColumn } from "../../src/wire/ticks.ts";
import { decodeTicks, FrameError, rowWidth } from "../../src/wire/ticks.ts";
import { expected, expectedByte, makeFrame } from "./frame.ts";

describe("a frame of ticks", () => {
  it.each([
    [1, 1, false],
    [26, 2, false],
    [3, 6, true],
    [5, 64, true],
    [2, 0, false],
  ])("of %i ticks and %i membranes reads as it was written", (count, membranes, other) => {
    const batch = decodeTicks(makeFrame({ first: 7, count, membranes, run: 3, lost: 9, other, time: 1.5 }));
    expect(batch).toMatchObject({ firstTick: 7, firstTime: 1.5, run: 3, lost: 9, count, membranes });
    const wrong: string[] = [];
    for (const [name, values] of Object.entries(batch.floats) as [FloatColumn, Float32Array][]) {
      const width = rowWidth(name, membranes);
      expect(values).toHaveLength(count * width);
      values.forEach((value, i) => {
        const row = Math.floor(i / width);
        if (value !== expected(name, name === "time" ? row : 7 + row, i % width)) wrong.push(`${name} ${i}`);
      });
    }
    for (const [name, values] of Object.entries(batch.bytes) as [ByteColumn, Uint8Array][]) {
      const width = rowWidth(name, membranes);
      expect(values).toHaveLength(count * width);
      values.forEach((value, i) => {
        if (value !== expectedByte(name, 7 + Math.floor(i / width), i % width)) wrong.push(`${name} ${i}`);
      });
    }
    expect(wrong).toEqual([]);
    expect(batch.otherForce?.length ?? 0).toBe(other ? 3 * count : 0);
  });

  it("keeps tick numbers beyond 32 bits", () => {
    expect(decodeTicks(makeFrame({ first: 2 ** 40 + 1, count: 1, membranes: 1 })).firstTick).toBe(2 ** 40 + 1);
  });

  it("that ends anywhere too early, or goes on too long, is a FrameError", () => {
    const whole = makeFrame({ count: 2, membranes: 2, other: true });
    const taken: number[] = [];
    for (let length = 0; length < whole.byteLength; length++) {
      try {
        decodeTicks(whole.slice(0, length));
        taken.push(length);
      } catch (error) {
        if (!(error instanceof FrameError)) taken.push(length);
      }
    }
    expect(taken).toEqual([]);
    const long = new Uint8Array(whole.byteLength + 1);
    long.set(new Uint8Array(whole));
    expect(() => decodeTicks(long.buffer)).toThrow(FrameError);
  });

  it("that claims more ticks than memory could hold is a FrameError before anything is taken", () => {
    const view = new DataView(makeFrame({ count: 1, membranes: 1 }));
    view.setUint32(4, 0xffffffff, true);
    expect(() => decodeTicks(view.buffer as ArrayBuffer)).toThrow(FrameError);
  });

  it("lies anywhere in a longer file", () => {
    const frame = new Uint8Array(makeFrame({ first: 4, count: 3, membranes: 1 }));
    const file = new Uint8Array(8 + frame.length + 8);
    file.set(frame, 8);
    expect(decodeTicks(file.buffer, 8, 8 + frame.length).firstTick).toBe(4);
  });
});
