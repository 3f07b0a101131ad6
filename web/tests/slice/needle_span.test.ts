import { Vector3 } from "three";
import { describe, expect, it } from "vitest";
import { type ProbePlace, placeAtNeedle, planeOf, type SkinFrame } from "../../src/scene/probe.ts";
import { BEAM, needleSpan } from "../../src/slice/needle_span.ts";

const skin: SkinFrame = {
  origin: new Vector3(),
  inward: new Vector3(0, -1, 0),
  right: new Vector3(1, 0, 0),
  front: new Vector3(0, 0, 1),
};
const AT_ORIGIN: ProbePlace = { x: 0, z: 0, turn: 0 };
const RADIUS = 0.4;
/** A needle at 30 degrees to the skin, pointing right and down, with its tip 6 mm below the skin. */
const tip = new Vector3(4, -6, 0);
const axis = new Vector3(Math.cos(Math.PI / 6), -Math.sin(Math.PI / 6), 0);

describe("in plane", () => {
  const place = placeAtNeedle(skin, tip, axis, false, AT_ORIGIN);

  it("the needle is a line from its tip to the skin, at its true depth and angle", () => {
    const span = needleSpan(planeOf(skin, place), tip, axis, 100, RADIUS)!;
    expect(span.tip).toBe(true);
    expect(span.off).toBeCloseTo(0, 9);
    expect(span.deep.depth).toBeCloseTo(6, 9);
    expect(span.deep.along).toBeCloseTo(0, 9); // the probe is over the tip
    expect(span.shallow.depth).toBeCloseTo(0, 9);
    const slope = (span.deep.depth - span.shallow.depth) / (span.deep.along - span.shallow.along);
    expect(Math.atan(slope)).toBeCloseTo(Math.PI / 6, 9);
  });

  it.each([-40, 25, 90])("for a needle that points %d degrees to the side, too", (degrees) => {
    const turned = axis.clone().applyAxisAngle(new Vector3(0, 1, 0), (degrees * Math.PI) / 180);
    const span = needleSpan(
      planeOf(skin, placeAtNeedle(skin, tip, turned, false, AT_ORIGIN)),
      tip,
      turned,
      100,
      RADIUS,
    )!;
    const long = Math.hypot(span.deep.along - span.shallow.along, span.deep.depth - span.shallow.depth);
    expect(long).toBeCloseTo(12, 6); // 6 mm deep at 30 degrees
  });

  it("a probe moved away loses brightness, then the needle", () => {
    const half = BEAM / 2 + RADIUS;
    const moved = (z: number) => needleSpan(planeOf(skin, { ...place, z }), tip, axis, 100, RADIUS);
    expect(moved(0.5 * half)!.off).toBeCloseTo(0.5, 6);
    expect(moved(1.01 * half)).toBeNull();
  });
});

describe("out of plane", () => {
  it("the needle is a dot at the depth at which it crosses the slice", () => {
    const across = placeAtNeedle(skin, tip, axis, true, AT_ORIGIN);
    const behind = { ...across, x: across.x - 6 }; // the shaft 6 mm behind the tip
    const span = needleSpan(planeOf(skin, behind), tip, axis, 100, RADIUS)!;
    const crossing = 6 - 6 * Math.tan(Math.PI / 6);
    expect(span.tip).toBe(false);
    expect(span.along).toBe(false);
    expect((span.deep.depth + span.shallow.depth) / 2).toBeCloseTo(crossing, 6);
    expect(Math.abs(span.deep.along - span.shallow.along)).toBeLessThan(1e-6);
    expect(span.deep.depth - span.shallow.depth).toBeLessThan(2 * (BEAM / 2 + RADIUS));
  });

  it("a slice ahead of the tip does not show the needle", () => {
    const across = placeAtNeedle(skin, tip, axis, true, AT_ORIGIN);
    expect(needleSpan(planeOf(skin, { ...across, x: across.x + 2 }), tip, axis, 100, RADIUS)).toBeNull();
  });

  it("a needle above the skin does not show", () => {
    const out = new Vector3(0, 3, 0);
    expect(needleSpan(planeOf(skin, AT_ORIGIN), out, axis, 100, RADIUS)).toBeNull();
  });
});

it("the picture's middle can be ahead of the tip, where the needle goes to", () => {
  const place = placeAtNeedle(skin, tip, axis, false, AT_ORIGIN, 3);
  const span = needleSpan(planeOf(skin, place), tip, axis, 100, RADIUS)!;
  expect(span.deep.along).toBeCloseTo(-3, 9);
  expect(span.along).toBe(true);
});

it("an upright needle keeps the probe's turn", () => {
  const turned = { x: 0, z: 0, turn: 0.3 };
  const place = placeAtNeedle(skin, new Vector3(1, -5, 2), new Vector3(0, -1, 0), false, turned);
  expect(place).toEqual({ x: 1, z: 2, turn: 0.3 });
});
