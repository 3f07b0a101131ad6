import { expect, it } from "vitest";
import { insetWords } from "../../src/scene/hub_inset.ts";
import { Moment } from "../../src/scene/moment.ts";
import { plungerOf } from "../../src/scene/needle.ts";
import { syringeParts, syringeSize } from "../../src/scene/needle_syringe.ts";
import { Source } from "../../src/state/source.ts";
import { batch } from "../support/fill_history.ts";

/** A push of 4 N for 200 ticks of 1 ms: the plunger moves 0.01 mm a tick between ticks 50 and 100. */
const source = new Source("test", true, 300);
source.history.push(
  batch(0, 300, 1, {
    plunger: (tick) => [1e-5 * Math.min(50, Math.max(0, tick - 50))],
    thumb_force: (tick) => [tick < 200 ? -4 : 0],
  }),
);
function wordsAt(tick: number, pressed = 0.1): string {
  source.cursor.value = tick;
  const moment = new Moment();
  moment.read(source);
  return insetWords({
    look: "tuohy",
    diameter: 1,
    blood: 0,
    pressed,
    plunger: plungerOf(moment),
    syringe: syringeSize({ syringe: null }),
    content: "epidural space",
  });
}

it("a plunger gives way while it moves under the thumb, and not for ever", () => {
  expect([0, 40, 80, 180, 250].map((tick) => wordsAt(tick))).toEqual([
    "Plunger: holds",
    "Plunger: holds",
    "Plunger: gives way",
    "Plunger: holds",
    "Plunger: not pushed",
  ]);
  expect(wordsAt(180, 1)).toBe("Syringe: empty");
});

it("a syringe is drawn as wide and as full as the scene's, and an empty one empty", () => {
  const { bore, travel } = syringeSize({ syringe: { bore: 0.012, volume: 5e-6 } });
  expect([bore, travel]).toEqual([expect.closeTo(6), expect.closeTo(44.21, 2)]);
  expect(syringeParts({ bore, travel }).length).toBeGreaterThan(travel);
  expect(syringeSize({ syringe: { bore: 0.012, volume: 0 } }).travel).toBe(0);
});
