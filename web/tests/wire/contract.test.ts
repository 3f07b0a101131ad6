import { describe, expect, it } from "vitest";
import { decodeTicks, FrameError } from "../../src/wire/ticks.ts";
import frames from "../controls/support/frames.json";

// What the server's tests read, too (tests/python/studio/test_studio_contract.py). They check that it has one of each
// message and request.

type Frame = (typeof frames)[number];

function bytes(frame: Frame): ArrayBuffer {
  return Uint8Array.from(atob(frame.bytes), (letter) => letter.charCodeAt(0)).buffer;
}

describe("a frame of the contract", () => {
  const sound = frames.filter((frame) => frame.holds && frame.head);
  it.each(sound.map((frame) => [frame.what, frame] as const))("%s, reads as it says", (_, frame) => {
    const batch = decodeTicks(bytes(frame));
    const { first_tick, first_time, run, lost, membranes, count } = frame.head!;
    expect(batch).toMatchObject({ firstTick: first_tick, firstTime: first_time, run, lost, membranes, count });
    const read = new Map<string, Float32Array | Uint8Array>([
      ...Object.entries(batch.floats),
      ...Object.entries(batch.bytes),
    ]);
    if (batch.otherForce) read.set("other_force", batch.otherForce);
    const held = Object.entries(frame.holds!).filter(([, values]) => values !== undefined);
    expect([...read.keys()].sort()).toEqual(held.map(([name]) => name).sort());
    for (const [name, values] of held) {
      expect([...read.get(name)!].map((x) => (Number.isNaN(x) ? null : x))).toEqual(values);
    }
  });

  const bad = frames.filter((frame) => !frame.holds);
  it.each(bad.map((frame) => [frame.what, frame] as const))("%s, is refused", (_, frame) => {
    expect(() => decodeTicks(bytes(frame))).toThrow(FrameError);
  });
});
