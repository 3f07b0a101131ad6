import { expect, test } from "vitest";
import { FEEDBACK, FEEDFORWARD } from "../../src/stage/sitting.ts";

test("masking noise has as much power in each octave", () => {
  const size = (coefficients: readonly number[], angle: number): number => {
    const sum = (wave: (x: number) => number): number =>
      coefficients.reduce((total, c, k) => total + c * wave(k * angle), 0);
    return Math.hypot(sum(Math.cos), sum(Math.sin));
  };
  for (const rate of [44_100, 48_000]) {
    const powers = [...Array(10).keys()].map((octave) => {
      const angle = (2 * Math.PI * 31.25 * 2 ** octave) / rate;
      return 10 * Math.log10(angle * (size(FEEDFORWARD, angle) / size(FEEDBACK, angle)) ** 2);
    });
    expect(Math.max(...powers) - Math.min(...powers)).toBeLessThan(1); // dB
  }
});
