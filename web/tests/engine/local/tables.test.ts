import { expect, it } from "vitest";
import { BlockClock } from "../../../src/engine/local/clock.ts";
import { withDefaults } from "../../../src/engine/local/defaults.ts";
import { tomlOf } from "../../../src/engine/local/files.ts";

it("writes tables as the text of a scene file", () => {
  const tables = {
    name: 'a "name"\n\\',
    needle: { diameter_mm: 1.08, tip_angle_deg: 1e-7 },
    display: { force_scale: "automatic" },
    membrane: [
      { name: "skin", point_mm: [0, -0.5, 1e21], grip_opening_mm: [] },
      { name: "vein", "odd key": Number.NaN },
    ],
  };
  expect(tomlOf(tables).split("\n")).toEqual([
    'name = "a \\"name\\"\\n\\\\"',
    "",
    "[needle]",
    "diameter_mm = 1.08",
    "tip_angle_deg = 1e-7",
    "",
    "[display]",
    'force_scale = "automatic"',
    "",
    "[[membrane]]",
    'name = "skin"',
    "point_mm = [0, -0.5, 1e+21]",
    "grip_opening_mm = []",
    "",
    "[[membrane]]",
    'name = "vein"',
    '"odd key" = nan',
    "",
  ]);
});

const SCHEMA = {
  $defs: {
    Servo: { properties: { rate_hz: { default: 1600 }, low_pass_hz: { default: 300 } } },
    Syringe: { properties: { bore_mm: {}, air_mL: { default: 0 } }, required: ["bore_mm"] },
    Membrane: { properties: { friction: {}, set: { default: 0 } }, required: ["friction"] },
  },
  properties: {
    name: { type: "string" },
    servo: { $ref: "#/$defs/Servo" },
    syringe: { $ref: "#/$defs/Syringe", default: null },
    membrane: { type: "array", items: { $ref: "#/$defs/Membrane" } },
  },
};

it("fills in the defaults of the schema, and no optional table", () => {
  expect(withDefaults({ name: "a", membrane: [{ friction: 0.2 }, { set: 1, own: 3 }] }, SCHEMA)).toEqual({
    name: "a",
    servo: { rate_hz: 1600, low_pass_hz: 300 },
    membrane: [
      { friction: 0.2, set: 0 },
      { set: 1, own: 3 },
    ],
  });
  expect(withDefaults({ servo: { rate_hz: 2000 }, syringe: { bore_mm: 9 } }, SCHEMA)).toEqual({
    servo: { rate_hz: 2000, low_pass_hz: 300 },
    syringe: { bore_mm: 9, air_mL: 0 },
  });
});

it("makes every tick of its rate, in blocks of any length", () => {
  const clock = new BlockClock(1600);
  let ticks = clock.due(50);
  for (let now = 50; now < 10_050; now += 7.3) ticks += clock.due(now);
  ticks += clock.due(10_050);
  expect(ticks).toBe(16_000);
  expect(clock.leftOut).toBe(0);
});

it("leaves out ticks after a long pause, and counts them", () => {
  const clock = new BlockClock(1600);
  clock.due(0);
  expect(clock.due(1000)).toBe(160);
  expect(clock.leftOut).toBe(1440);
  expect(clock.due(1010)).toBe(16);
  expect(clock.leftOut).toBe(1440);
});

it("counts nothing as left out while nobody looks at the page", () => {
  const clock = new BlockClock(1600);
  clock.due(0);
  expect(clock.due(10)).toBe(16);
  clock.sleep();
  expect(clock.due(60_000)).toBe(0);
  expect(clock.due(60_010)).toBe(16);
  expect(clock.leftOut).toBe(0);
});
