import { describe, expect, it, test } from "vitest";
import { drawHistogram, duration, RateMeter } from "../../src/controls/health.ts";
import { limitFigures } from "../../src/controls/limit_figures.ts";
import { SvgPen } from "../../src/plots/kit/svg_pen.ts";
import { CSS_THEME } from "../../src/plots/kit/theme.ts";
import type { Spread } from "../../src/wire/messages.ts";
import { LIMITS } from "../support/limits.ts";

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

  /** Left edge, width and height of each bar, px. */
  function bars(spread: Partial<Spread>, nominal: number): number[][] {
    const pen = new SvgPen();
    const whole = { p50: nominal, p99: 1, p99_9: 1, largest: nominal, edges: [], counts: [], ...spread };
    drawHistogram(pen, whole, nominal, duration, 400, 118, CSS_THEME);
    const boxes = pen
      .file(400, 118, "none", "", "")
      .matchAll(/<rect x="([^"]*)" y="[^"]*" width="([^"]*)" height="([^"]*)"/g);
    return [...boxes].map(([, ...numbers]) => numbers.map(Number));
  }

  it("a bar stands where its time is on the logarithmic axis, and one tick in a million is to be seen", () => {
    const [many, one] = bars({ edges: [1e-3 / 8, 5e-4, 2e-3], counts: [1_000_000, 1] }, 1e-3); // the axis: 1/8 to 2 ms
    expect(many).toEqual([0, expect.closeTo(199.6, 1), 100]);
    expect(one).toEqual([expect.closeTo(200, 1), expect.closeTo(199.6, 1), expect.closeTo(10, 1)]);
  });

  it("no bar lies outside, and nothing is drawn of nothing", () => {
    expect(bars({ counts: [0, 0], edges: [1, 2, 3] }, 1e-3)).toEqual([]);
    const outside = bars({ edges: [0, 1e-9, 2e-9], counts: [1, 1] }, 1e-3);
    expect(outside).toHaveLength(2);
    expect(outside.every(([left, width]) => left! >= 0 && left! + width! <= 400)).toBe(true);
  });

  it("the rate is ticks over time, and restarts with a run", () => {
    const meter = new RateMeter();
    expect(meter.add(0, 0)).toBeNull();
    for (let t = 0.25; t < 10; t += 0.25) expect(meter.add(t, t * 1600)).toBeCloseTo(1600, 6);
    expect(meter.add(10, 4)).toBeNull();
    expect(meter.add(10.5, 804)).toBeCloseTo(1600, 6);
  });
});

test("every limit is told with its unit", () => {
  const told = limitFigures({ ...LIMITS, stale: 0.015 });
  expect(Object.fromEntries(told.map(({ label, value }) => [label, value]))).toEqual({
    "peak force": "3.3 N",
    "long-run force": "0.88 N rms in any 10 s",
    "warm motors": "from 80 %",
    "ramp of the force": "0.5 s",
    "speed of the hand": "8 m/s",
    "same reading again": "15 ms",
    "late tick": "1 s",
    "needle’s direction": "length 1 ± 0.001",
    "dead-man button": "none",
  });
});

test("the dead-man buttons are named by their numbers", () => {
  expect(limitFigures({ ...LIMITS, dead_man_buttons: [1, 3] }).at(-1)?.value).toBe("button 1 or 3");
});
