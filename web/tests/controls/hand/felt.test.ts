import { describe, expect, it } from "vitest";
import { Felt } from "../../../src/controls/hand/felt.ts";
import { Source } from "../../../src/state/source.ts";
import type { MembraneEvent } from "../../../src/wire/messages.ts";
import { decodeTicks } from "../../../src/wire/ticks.ts";
import { makeFrame } from "../../wire/frame.ts";

const event = (tick: number, what: MembraneEvent["what"] = "pop", membrane = 0): MembraneEvent => ({
  kind: "event", what, membrane, name: "skin", tick, time: tick / 1600, depth: 0,
  force_before: 0.7, force_after: 0.4, drop: 0.3,
}); // biome-ignore format: short

function source(ticks: number): Source {
  const made = new Source("test", false, 10_000);
  made.history.push(decodeTicks(makeFrame({ count: ticks, membranes: 1 })));
  return made;
}

describe("pops", () => {
  it("are reported once, when the shown tick reaches them", () => {
    const felt = new Felt();
    const shown = source(4000);
    shown.events.value = [event(100, "touch"), event(500), event(900)];
    shown.cursor.value = 400;
    expect(felt.pops(shown)).toEqual([]);
    shown.cursor.value = 520;
    expect(felt.pops(shown).map(({ tick }) => tick)).toEqual([500]);
    expect(felt.pops(shown)).toEqual([]);
    shown.cursor.value = 1000;
    expect(felt.pops(shown).map(({ tick }) => tick)).toEqual([900]);
  });

  it("of a live run may come a little after their tick", () => {
    const felt = new Felt();
    const live = source(1600);
    felt.pops(live);
    live.events.value = [event(1500)];
    expect(felt.pops(live)).toHaveLength(1);
  });

  it("that lie before a jump back, or in another run, stay silent", () => {
    const felt = new Felt();
    const shown = source(4000);
    shown.events.value = [event(500)];
    shown.cursor.value = 600;
    expect(felt.pops(shown)).toEqual([]);
    shown.cursor.value = 300;
    expect(felt.pops(shown)).toEqual([]);
    shown.cursor.value = 510;
    expect(felt.pops(shown)).toHaveLength(1);
    const other = source(4000);
    other.events.value = [event(3990)];
    expect(felt.pops(other)).toEqual([]);
  });
});

describe("the power of friction", () => {
  /** Sliding in at 20 mm/s under 0.5 N, then at rest. */
  function run(phase: number): Source {
    const made = new Source("test", false, 10_000);
    const batch = decodeTicks(makeFrame({ count: 200, membranes: 1 }));
    batch.bytes.phase.fill(phase);
    batch.floats.axial_force.fill(-0.5);
    batch.floats.depth.forEach((_, i, all) => {
      all[i] = 0.02 * (Math.min(i, 100) / 1600);
    });
    made.history.push(batch);
    return made;
  }

  it("is force times speed while the needle slides", () => {
    const sliding = run(2);
    sliding.cursor.value = 90;
    expect(new Felt().power(sliding)).toBeCloseTo(0.5 * 0.02, 4);
    sliding.cursor.value = 199;
    expect(new Felt().power(sliding)).toBe(0);
  });

  it("is none while it sticks", () => {
    const sticking = run(1);
    sticking.cursor.value = 90;
    expect(new Felt().power(sticking)).toBe(0);
  });
});
