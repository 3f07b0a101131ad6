import { describe, expect, it } from "vitest";
import frames from "../../../tests/contract/frames.json";
import contract from "../../../tests/contract/messages.json";
import type { Message, Request } from "../../src/wire/messages.ts";
import { decodeTicks, FrameError } from "../../src/wire/ticks.ts";

// What the server's tests read, too: tests/python/studio/test_studio_contract.py.

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

it("has one of each kind of message and request that the page has a type for", () => {
  const kinds: Record<Message["kind"], true> = {
    hello: true, scene: true, laws: true, control: true, status: true, fault: true, event: true,
    estimate: true, recording: true,
    exercise: true, sitting: true, reply: true, notice: true,
  }; // biome-ignore format: a table
  const requests: Record<Request["do"], true> = {
    take_control: true, arm: true, pause: true, reset: true, target: true,
    awake: true, took: true, strokes: true,
    push_plunger: true, play_motion: true, edit: true,
    load: true, load_text: true, compare: true, estimate: true,
    start_recording: true, stop_recording: true, start_exercise: true,
    set_expert: true,
    check_exercise: true,
    try_exercise: true,
    save_exercise: true,
    open_exercise: true,
    delete_exercise: true,
    end_exercise: true, respond: true, trip_fault: true,
  }; // biome-ignore format: a table
  expect(contract.messages.map((message) => message.kind).sort()).toEqual(Object.keys(kinds).sort());
  expect(contract.requests.map((request) => request.do).sort()).toEqual(Object.keys(requests).sort());
});
