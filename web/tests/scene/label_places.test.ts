import { describe, expect, it } from "vitest";
import { type Place, placeLabels, type Rect, type Wish } from "../../src/scene/label_places.ts";

const label = (id: string, x: number, y: number, how: Wish["how"] = "column", width = 120): Wish => ({
  id, width, height: 18, x, y, how,
}); // biome-ignore format: one line

const overlap = (a: Rect, b: Rect): boolean =>
  a.left < b.right && b.left < a.right && a.top < b.bottom && b.top < a.bottom;

function clear(places: readonly Place[], width: number, height: number, obstacles: readonly Rect[]): void {
  const wrong = places.filter(
    (place, i) =>
      place.left < 0 ||
      place.top < 0 ||
      place.right > width ||
      place.bottom > height ||
      [...places.slice(i + 1), ...obstacles].some((other) => overlap(place, other)),
  );
  expect(wrong).toEqual([]);
}

/** A toolbar above, a note below on the left, a scale below on the right. */
const around = (width: number, height: number): Rect[] => [
  { left: 8, top: 8, right: Math.min(width - 8, 300), bottom: 52 },
  { left: 10, top: height - 40, right: width - 190, bottom: height - 7 },
  { left: width - 120, top: height - 30, right: width - 12, bottom: height - 8 },
];

const EPIDURAL = [
  "skin", "subcutaneous fat", "supraspinous ligament", "interspinous ligament", "ligamentum flavum", "dura",
]; // biome-ignore format: a list

describe.each([
  ["a desktop", 560, 490],
  ["a phone", 374, 470],
  ["a screen at 200 %", 340, 260],
])("on %s", (_, width, height) => {
  it("from above, where all layers lie on each other, every layer has its label and none overlaps", () => {
    const wishes = EPIDURAL.map((name) => label(name, 0.7 * width, 0.5 * height));
    const places = placeLabels(wishes, width, height, around(width, height));
    expect(places.map(({ id }) => id).sort()).toEqual([...EPIDURAL].sort());
    clear(places, width, height, around(width, height));
  });

  it("with the force and the entry's direction among them, none overlaps", () => {
    const wishes = EPIDURAL.map((name, i) => label(name, 0.7 * width, (0.4 + 0.02 * i) * height));
    wishes.push(
      label("force", 0.65 * width, 0.45 * height, "left", 60),
      label("entry", 0.6 * width, 0.5 * height, "right", 90),
    );
    const places = placeLabels(wishes, width, height, around(width, height));
    expect(places).toHaveLength(8);
    clear(places, width, height, around(width, height));
  });
});

it("a label for which the column has no room goes wherever there is some", () => {
  const [width, height] = [374, 250];
  const full: Rect[] = [
    ...around(width, height),
    { left: 8, top: 8, right: 366, bottom: 66 }, // a toolbar of two rows
    { left: 250, top: 74, right: 366, bottom: 190 }, // the magnifier
  ];
  const wishes = EPIDURAL.map((name) => label(name, 262, 125));
  const places = placeLabels(wishes, width, height, full);
  expect(places.map(({ id }) => id).sort()).toEqual([...EPIDURAL].sort());
  clear(places, width, height, full);
});

it("whatever the points, no label overlaps another one or an obstacle", () => {
  let state = 7;
  const next = (): number => {
    state = (state * 48271) % 2147483647;
    return state / 2147483647;
  };
  for (let trial = 0; trial < 300; trial++) {
    const [width, height] = [250 + 500 * next(), 220 + 400 * next()];
    const wishes = Array.from({ length: 12 }, (_, i) =>
      label(`l${i}`, width * next(), height * next(), (["column", "left", "right"] as const)[i % 3], 20 + 100 * next()),
    );
    clear(placeLabels(wishes, width, height, around(width, height)), width, height, around(width, height));
  }
});

it("a label with room stays at the height of its point, and lines do not cross", () => {
  const wishes = [label("c", 200, 300), label("a", 210, 100), label("b", 190, 104)];
  const places = placeLabels(wishes, 500, 500, []);
  const top = (id: string): number => places.find((place) => place.id === id)!.top;
  expect(top("a")).toBeCloseTo(91, 6);
  expect(top("b")).toBeCloseTo(top("a") + 20, 6);
  expect(top("c")).toBeCloseTo(291, 6);
});

it("labels at the lower border move up", () => {
  const wishes = ["a", "b", "c"].map((id) => label(id, 200, 495));
  clear(placeLabels(wishes, 500, 500, []), 500, 500, []);
  expect(placeLabels(wishes, 500, 500, [])).toHaveLength(3);
});

it("a label next to its point needs no line; one that had to move away has one", () => {
  const [near] = placeLabels([label("force", 250, 250, "right", 60)], 500, 500, []);
  expect(near!.line).toBeNull();
  expect(near!.left).toBe(258);
  const wall = { left: 0, top: 180, right: 500, bottom: 320 };
  const [far] = placeLabels([label("force", 250, 250, "right", 60)], 500, 500, [wall]);
  expect(far!.line).not.toBeNull();
});
