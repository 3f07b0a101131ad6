import { Vector3 } from "three";
import { describe, expect, it } from "vitest";
import { Moment } from "../../src/scene/moment.ts";
import { sentence } from "../../src/scene/spoken.ts";
import type { SceneView } from "../../src/wire/messages.ts";
import { wordsOf } from "../../src/wire/ticks.ts";

const scene = { membranes: [{ name: "skin" }, { name: "vein wall" }] } as SceneView;
const moment = (...states: [phase: number, depth: number][]): Moment => {
  const made = new Moment();
  made.membranes = states.map(([phase, depth]) => ({ phase, depth, proxy: new Vector3(), direction: new Vector3() }));
  return made;
};

describe("the sentence", () => {
  it("names each membrane in which the tip is, what it does there, and how deep", () => {
    expect(sentence(moment([2, 5.26], [1, 0.31]), scene)).toBe(
      "The tip is sliding into skin at 5.3 mm, sticking in vein wall at 0.3 mm.",
    );
    expect(sentence(moment([3, 1], [0, 0]), scene)).toBe("The tip is sliding out of skin at 1.0 mm.");
    expect(sentence(moment([0, 0], [0, 0]), scene)).toBe("The tip is outside all membranes.");
  });

  it("says that a barred membrane gives no force", () => {
    const barred = wordsOf("phase").indexOf("barred");
    expect(sentence(moment([barred, 2], [0, 0]), scene)).toBe("The tip is without force in skin at 2.0 mm.");
  });
});
