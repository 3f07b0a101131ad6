import { describe, expect, it } from "vitest";
import { decimate } from "../../../src/plots/kit/decimate.ts";
import { Polyline } from "../../../src/plots/kit/polyline.ts";

const NaN_ = Number.NaN;

function through(xs: number[], ys: number[]): Array<[number, number]> {
  const out = new Polyline(2);
  decimate(Float32Array.from(xs), Float32Array.from(ys), 0, xs.length, out);
  return Array.from({ length: out.count }, (_, i) => [out.xs[i]!, out.ys[i]!]);
}

describe("lines through pixel columns", () => {
  it("a spike of one tick among a million keeps its full height", () => {
    const n = 1_000_000;
    const xs = new Float32Array(n);
    const ys = new Float32Array(n).fill(10);
    for (let i = 0; i < n; i++) xs[i] = (i / n) * 500;
    ys[333_333] = 99.5;
    ys[700_001] = -42;
    const out = new Polyline();
    decimate(xs, ys, 0, n, out);
    const drawn = out.ys.subarray(0, out.count);
    expect(drawn).toContain(99.5);
    expect(drawn).toContain(-42);
    expect(out.count).toBeLessThanOrEqual(4 * 500);
  });

  it("every point that is drawn is a point that was given, in its order", () => {
    expect(through([1, 1.1, 1.2, 1.3, 1.4, 2.5], [5, 9, 1, 3, 4, 7]).map(([, y]) => y)).toEqual([5, 9, 1, 4, 7]);
    expect(through([1, 1.1, 1.2, 1.3, 1.4, 2.5], [5, 1, 9, 3, 4, 7]).map(([, y]) => y)).toEqual([5, 1, 9, 4, 7]);
  });

  it("random data keep their lowest and highest in every column", () => {
    let seed = 7;
    const random = (): number => {
      seed = (seed * 1103515245 + 12345) % 2147483648;
      return seed / 2147483648;
    };
    const xs = Float32Array.from({ length: 5000 }, (_, i) => i / 50);
    const ys = Float32Array.from({ length: 5000 }, random);
    const points = through([...xs], [...ys]);
    for (let column = 0; column < 100; column++) {
      const given = [...ys.subarray(column * 50, column * 50 + 50)];
      const drawn = points.filter(([x]) => Math.floor(x) === column).map(([, y]) => y);
      expect(Math.max(...drawn)).toBe(Math.max(...given));
      expect(Math.min(...drawn)).toBe(Math.min(...given));
    }
  });

  it("what does not exist is a gap, one for any number of ticks", () => {
    expect(through([1, 2, 3, 4, 5], [1, NaN_, NaN_, 4, 5])).toEqual([
      [1, 1],
      [NaN_, NaN_],
      [4, 4],
      [5, 5],
    ]);
    expect(through([1, 2], [NaN_, NaN_])).toEqual([]);
  });

  it("a way to and fro is kept, although it meets a column twice", () => {
    expect(through([0, 5, 0], [0, 1, 2])).toEqual([
      [0, 0],
      [5, 1],
      [0, 2],
    ]);
  });
});
