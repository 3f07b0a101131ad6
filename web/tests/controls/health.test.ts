import { describe, expect, it } from "vitest";
import { duration } from "../../src/controls/health.ts";
import { bars, logPlace } from "../../src/controls/histogram.ts";
import { RateMeter } from "../../src/controls/rate.ts";

describe("loop health", () => {
  it("durations have three digits and a unit that fits", () => {
    expect([625e-6, 9.63e-6, 0.00144, 12.34e-6, 2].map(duration)).toEqual([
      "625 µs",
      "9.63 µs",
      "1.44 ms",
      "12.3 µs",
      "2.00 s",
    ]);
    expect(duration(0.99996e-3)).toBe("1.00 ms");
  });

  it("a bar stands where its time is on the logarithmic axis, and one tick is to be seen", () => {
    const spread = { p50: 1, p99: 1, p99_9: 1, largest: 1, edges: [1e-4, 1e-3, 1e-2], counts: [1_000_000, 1] };
    const [many, one] = bars(spread, 1e-4, 1e-2);
    expect(many).toMatchObject({ left: 0, width: expect.closeTo(0.5), height: 1 });
    expect(one).toMatchObject({ left: expect.closeTo(0.5), height: expect.closeTo(0.1) });
    expect(logPlace(1e-6, 1e-4, 1e-2)).toBe(0);
    expect(bars({ ...spread, counts: [0, 0] }, 1e-4, 1e-2)).toEqual([]);
    expect(bars({ ...spread, edges: [0, 1e-9, 2e-9], counts: [1, 1] }, 1e-9, 1e-2).every(({ left }) => left >= 0)).toBe(
      true,
    );
  });

  it("the rate is ticks over time, and restarts with a run", () => {
    const meter = new RateMeter();
    expect(meter.add(0, 0)).toBeNull();
    for (let t = 0.25; t < 10; t += 0.25) expect(meter.add(t, t * 1600)).toBeCloseTo(1600, 6);
    expect(meter.add(10, 4)).toBeNull();
    expect(meter.add(10.5, 804)).toBeCloseTo(1600, 6);
  });
});
