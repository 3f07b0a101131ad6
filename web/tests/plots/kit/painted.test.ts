import { describe, expect, it } from "vitest";
import { Painted } from "../../../src/plots/kit/painted.ts";
import { Polyline } from "../../../src/plots/kit/polyline.ts";

const line = (points: ReadonlyArray<readonly [number, number]>): Polyline => {
  const made = new Polyline();
  for (const [x, y] of points) made.add(x, y);
  return made;
};
const points = ({ xs, ys, count }: Polyline): Array<[number, number]> =>
  Array.from({ length: count }, (_, i): [number, number] => [xs[i]!, ys[i]!]).filter(([, y]) => !Number.isNaN(y));

describe("ink that is there already", () => {
  const stroke = Array.from({ length: 50 }, (_, i) => [i, 20] as const);

  it("a second stroke along the first is not drawn again", () => {
    const painted = new Painted();
    painted.begin(0, 0, 100, 100);
    const first = new Polyline();
    painted.addNew(line(stroke), first);
    expect(points(first)).toEqual(stroke);
    const second = new Polyline();
    painted.addNew(line(stroke), second);
    expect(points(second)).toEqual([]);
  });

  it("a spike out of it is drawn from foot to tip and back", () => {
    const painted = new Painted();
    painted.begin(0, 0, 100, 100);
    painted.addNew(line(stroke), new Polyline());
    const spiked = stroke.map(([x, y]) => [x, x === 25 ? 80 : y] as const);
    const out = new Polyline();
    painted.addNew(line(spiked), out);
    expect(points(out)).toEqual([
      [24, 20],
      [25, 80],
      [26, 20],
    ]);
  });

  it("a slow stroke, many points to a pixel, has no gap", () => {
    const painted = new Painted();
    painted.begin(0, 0, 100, 100);
    const slow = Array.from({ length: 300 }, (_, i) => [i / 8, 20 + 0.25 * (i % 3)] as const);
    const out = new Polyline();
    painted.addNew(line(slow), out);
    expect(points(out)).toEqual(slow.map((point) => point.map(Math.fround)));
  });

  it("another drawing begins without ink", () => {
    const painted = new Painted();
    painted.begin(0, 0, 100, 100);
    painted.addNew(line(stroke), new Polyline());
    painted.begin(0, 0, 100, 100);
    const out = new Polyline();
    painted.addNew(line(stroke), out);
    expect(points(out)).toEqual(stroke);
  });
});
