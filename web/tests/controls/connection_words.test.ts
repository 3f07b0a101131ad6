import { describe, expect, it } from "vitest";
import { connectionWords, STATES } from "../../src/controls/words.ts";

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
