import { describe, expect, it } from "vitest";
import { connectionWords, eventsSince, eventWords, phaseWords, popSentence, STATES } from "../../src/controls/words.ts";
import type { MembraneEvent } from "../../src/wire/messages.ts";
import { history } from "../support/fill_history.ts";

describe("the phase in words", () => {
  it("each has a symbol and a word of its own", () => {
    const all = [0, 1, 2, 3, 4].map((phase) => phaseWords(phase, 1e-3, 5e-3));
    expect(all.map(({ word }) => word)).toEqual(["outside", "sticking", "sliding in", "sliding out", "barred"]);
    const through = phaseWords(2, 6e-3, 5e-3);
    expect(through).toMatchObject({ word: "through", detail: "going in" });
    expect(phaseWords(1, 6e-3, 5e-3)).toMatchObject({ word: "through", detail: "at rest" });
    expect(new Set([...all, through].map(({ symbol }) => symbol)).size).toBe(6);
    expect(new Set([...all, through].map(({ kind }) => kind)).size).toBe(6);
  });
  it("through is from the depth at which the law says so, and only inside", () => {
    expect(phaseWords(1, 5e-3, 5e-3).word).toBe("through");
    expect(phaseWords(1, 4.999e-3, 5e-3).word).toBe("sticking");
    expect(phaseWords(0, 9e-3, 5e-3).word).toBe("outside");
    expect(phaseWords(4, 9e-3, 5e-3).word).toBe("barred");
    expect(phaseWords(0, Number.NaN, 5e-3).word).toBe("outside");
  });
});

describe("what happened in words", () => {
  const event = (tick: number, what: MembraneEvent["what"]): MembraneEvent => ({
    kind: "event", what, membrane: 0, name: "skin", tick, time: tick / 1600, depth: 0,
    force_before: 0.5, force_after: 0.26, drop: 0.24,
  }); // biome-ignore format: one line
  it("a pop shows the drop of the force", () => {
    const run = (felt: number) => history(10, 1, { model_force: () => [0, 2, 0], force: () => [0, felt, 0] });
    expect(eventWords(event(1, "pop"), run(2))).toEqual({ word: "pop", force: "−0.24 N" });
    expect(popSentence(event(1, "pop"), run(2))).toBe("Pop through skin: the force fell by 0.24 newtons.");
    expect(eventWords(event(1, "pop"), run(0.6)).force).toBe("model force −0.24 N");
    expect(popSentence(event(1, "pop"), run(0))).toBe("Pop through skin: the model force fell by 0.24 newtons.");
    expect(eventWords(event(1, "touch"), run(2)).force).toBe("");
  });
  it("only new events are added; another run starts again", () => {
    const [a, b, c, d] = [event(1, "touch"), event(2, "pop"), event(3, "out"), event(4, "touch")] as const;
    expect(eventsSince([a, b], [a, b, c, d])).toEqual([c, d]);
    expect(eventsSince([a, b, c], [c, d])).toEqual([d]);
    expect(eventsSince([], [a])).toEqual([a]);
    expect(eventsSince([a, b], [c])).toBeNull();
    expect(eventsSince([a], [])).toBeNull();
  });
});

describe("the connection in words", () => {
  it("tells the state, and when the page retries", () => {
    expect(connectionWords({ state: "open" }, false, 0)).toBe("Connected");
    expect(connectionWords({ state: "open" }, true, 0)).toBe("Connected, but no ticks");
    expect(connectionWords({ state: "connecting", attempt: 1 }, false, 0)).toBe("Connecting");
    expect(connectionWords({ state: "connecting", attempt: 3 }, false, 0)).toBe("Connecting, attempt 3");
    const lost = { state: "lost", reason: "", retryInMs: 4000 } as const;
    expect(connectionWords(lost, false, 3200)).toBe("No connection; retry in 4 s");
    expect(connectionWords(lost, false, -10)).toBe("No connection; retry in 0 s");
    expect(connectionWords({ state: "refused", reason: "wrong token" }, false, 0)).toBe("Refused: wrong token");
  });

  it("has a mark of its own for each state of the force, so that colour is not needed", () => {
    expect(STATES.map(({ name }) => name)).toEqual(["disarmed", "waiting", "active", "faulted"]);
    expect(new Set(STATES.map(({ mark }) => mark)).size).toBe(4);
  });
});
