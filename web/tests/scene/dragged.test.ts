import { Box3, Color, type Mesh, PerspectiveCamera, Vector3 } from "three";
import { describe, expect, it } from "vitest";
import { extentOf } from "../../src/scene/anatomy.ts";
import { Block } from "../../src/scene/block.ts";
import { Blood } from "../../src/scene/blood.ts";
import { Holes } from "../../src/scene/holes.ts";
import { Membranes } from "../../src/scene/membranes.ts";
import { Moment, OUTSIDE } from "../../src/scene/moment.ts";
import type { Theme } from "../../src/scene/theme.ts";
import type { SceneView } from "../../src/wire/messages.ts";
import { plainScene } from "../support/plain_scene.ts";

const theme = {
  dark: false,
  color: () => new Color(0.5, 0.5, 0.5),
  membrane: () => new Color(0.2, 0.4, 0.6),
  watch: (listener: () => void) => listener(),
} as unknown as Theme;
const STICKING = 1;
const TILTED = new Vector3(Math.sin(Math.PI / 3), -Math.cos(Math.PI / 3), 0); // 30 degrees to the skin

const sheets = plainScene;
const block: SceneView = {
  ...sheets,
  membranes: sheets.membranes.map((m, i) => ({ ...m, look: i === 0 ? "skin" : "vein wall", behind: "fat" })),
};

/** The needle entered at the origin; its tip was then dragged straight down, away from its track. */
function dragged(scene: SceneView, down: number): Moment {
  const moment = new Moment();
  moment.axis.copy(TILTED);
  moment.tip.set(0, -down, 0);
  moment.membranes = scene.membranes.map(({ point }) => {
    const from = -point[1]! * 1000;
    const inside = down > from;
    // The proxy can move along the track only: half as far as the tip went down.
    const proxy = TILTED.clone().multiplyScalar(Math.max(0, 2 * from + 0.5 * (down - from)));
    return {
      phase: inside ? STICKING : OUTSIDE,
      depth: 1,
      proxy,
      direction: inside ? TILTED.clone() : new Vector3(),
    };
  });
  return moment;
}

const points = ({ geometry }: Mesh): number[] => Array.from(geometry.getAttribute("position").array);

function drawSheets(): (moment: Moment) => Mesh[] {
  const membranes = new Membranes(theme);
  const blood = new Blood(theme);
  membranes.build(sheets, extentOf(sheets).size);
  blood.build(sheets.lumen);
  return (moment) => {
    membranes.update(moment, new Holes());
    blood.update(membranes, moment.axis);
    return [...membranes.placed.map(({ slab }) => slab.mesh), blood.slab.mesh];
  };
}

function drawBlock(more = 0): (moment: Moment) => Mesh[] {
  const drawn = new Block(theme);
  drawn.build(block, extentOf(block).size, more, more);
  const camera = new PerspectiveCamera();
  camera.position.set(20, 20, 90);
  return (moment) => {
    drawn.update(moment, new Holes(), camera, 0);
    const meshes = drawn.group.children.filter((child): child is Mesh => "isMesh" in child);
    return meshes.filter(({ geometry }) => "shade" in geometry.attributes);
  };
}

describe.each([
  ["sheets", drawSheets],
  ["a block", drawBlock],
  ["a block that goes on at both ends", () => drawBlock(60)],
] as const)("a tilted needle that is dragged straight down through %s", (_, drawing) => {
  it("leaves the drawn tissue whole, of bounded size, and as it was before when it is back", () => {
    const draw = drawing();
    const at = (down: number): number[] => draw(dragged(sheets, down)).flatMap(points);
    const before = at(-1);
    const width = new Box3().setFromArray(before).getSize(new Vector3());
    for (const down of [0.5, 2, 5, 10, 20, 50, 200]) {
      const all = at(down);
      expect(all.every(Number.isFinite)).toBe(true);
      const size = new Box3().setFromArray(all).getSize(new Vector3());
      expect(size.x).toBeLessThan(width.x + 9);
      expect(size.y).toBeLessThan(width.y + 12);
      expect(size.z).toBeLessThan(width.z + 9);
    }
    const apart = at(-1).map((x, i) => Math.abs(x - before[i]!));
    expect(apart.reduce((most, x) => Math.max(most, x), 0)).toBeLessThan(1e-3);
  });
});
