import { describe, expect, it } from "vitest";
import { ForceDepthDrawing, forceDepthCurves } from "../../src/plots/force_depth_drawing.ts";
import type { ForceDepthPicture } from "../../src/plots/force_depth_picture.ts";
import { Hidden } from "../../src/plots/kit/legend.ts";
import { SvgPen } from "../../src/plots/kit/svg_pen.ts";
import type { Theme } from "../../src/plots/kit/theme.ts";
import { reading } from "../../src/plots/reading.ts";
import { TimeDrawing, timeCurves } from "../../src/plots/time_drawing.ts";
import { Window } from "../../src/plots/window.ts";
import { Source } from "../../src/state/source.ts";
import { batch, type Cell } from "../support/fill_history.ts";

const theme: Theme = {
  panel: "white", line: "silver", text: "black", quiet: "gray", accent: "navy", danger: "maroon",
  data: ["blue", "red"],
}; // biome-ignore format: one line
const SPIKE = 12_345;

/** 20 s at 1 kHz: a slow stroke, and one tick with a force of 3 N. */
function source(more: Cell = {}): Source {
  const made = new Source("test", true, 20_000);
  made.laws.value = [
    {
      name: "skin", obliquity: 0, far_face: 1e-3, through: 5e-3,
      depth: [0, 4e-3, 5e-3], lower: [-0.2, -0.5, -0.25], upper: [0.1, 0.1, 0.25],
    }, // biome-ignore format: one line
  ];
  const cells: Cell = {
    depth: (tick) => [(8e-3 * tick) / 20_000],
    axial_force: (tick) => [tick === SPIKE ? -3 : -0.25],
    direction: () => [0, -1, 0],
    axis: () => [0, -1, 0],
    phase: () => [2],
    state: () => [2],
    ...more,
  };
  for (let first = 0; first < 20_000; first += 1000) made.history.push(batch(first, 1000, 1, cells));
  return made;
}

const window20 = (from: Source): Window => {
  const window = new Window();
  window.follow(from.history, from.shown(), 20, true, 20 / 400);
  return window;
};

/** Heights of the points of all lines in a colour. */
function heights(file: string, colour: string): number[] {
  const paths = [
    ...file.matchAll(new RegExp(`<path d="([^"]*)"[^>]*stroke="${colour}" stroke-width="(?:1\\.[56]|2)"`, "g")),
  ];
  return paths.flatMap(([, d]) => [...d!.matchAll(/[ML]([-\d.]+) ([-\d.]+)/g)].map((point) => Number(point[2])));
}

describe("force against depth", () => {
  const picture = (from: Source): ForceDepthPicture => ({
    source: from,
    window: window20(from),
    shown: from.shown(),
    chosen: null,
    overlay: null,
    comparison: null,
    zoom: null,
    oldest: 0.2,
    pointed: null,
    hidden: new Hidden("test"),
  });
  const drawn = (now: ForceDepthPicture): { drawing: ForceDepthDrawing; file: string } => {
    const drawing = new ForceDepthDrawing();
    drawing.arrange(now, 480, 400, 0);
    const pen = new SvgPen();
    drawing.draw(pen, now, theme);
    return { drawing, file: pen.file(480, 400, "white", "", "") };
  };

  it("one tick of 20 000 that stands out is drawn at its height", () => {
    const { drawing, file } = drawn(picture(source()));
    expect(Math.min(...heights(file, "blue"))).toBeCloseTo(drawing.pane.y.px(3), 1);
  });

  it("the friction band lies behind, mirrored so that what pushes the needle out is up", () => {
    const { drawing, file } = drawn(picture(source()));
    const band = /<path d="([^"]*)Z" fill="blue"/.exec(file)![1]!;
    const { x, y } = drawing.pane;
    const at = (depth: number, force: number): string =>
      `${Math.round(x.px(depth) * 100) / 100} ${Math.round(y.px(force) * 100) / 100}`;
    expect(band).toContain(at(4, 0.5));
    expect(band).toContain(at(4, -0.1));
  });

  it("the words of a pop too small to be seen do not lie on the names of the curves", () => {
    const from = source();
    const pop = { kind: "event", what: "pop", membrane: 0, name: "skin", tick: 9000, time: 9, depth: 5e-3 } as const;
    const told = (drop: number): string => {
      from.events.value = [{ ...pop, force_before: 0.3, force_after: 0.3 - drop, drop }];
      return drawn(picture(from)).file;
    };
    expect(told(0.25)).toContain(">pop −0.25 N<");
    expect(told(0.01)).not.toContain(">pop −0.01 N<");
  });

  it("the point nearest to the pointer is found", () => {
    const now = picture(source());
    const { drawing } = drawn(now);
    const { x, y } = drawing.pane;
    expect(drawing.nearest(now, x.px((8 * SPIKE) / 20_000) + 3, y.px(3) - 2, 20)).toEqual({ tick: SPIKE, membrane: 0 });
    expect(drawing.nearest(now, x.px(2), y.px(2.5), 20)).toBeNull();
  });

  it("an earlier run and the other solver are laid over, with names in the legend", () => {
    const other = (tick: number): number[] => [0, tick === 777 ? 1.5 : 0.25, 0];
    const from = source({ other_force: other, model_force: () => [0, 0.25, 0] });
    const { file } = drawn({ ...picture(from), overlay: source() });
    const names = forceDepthCurves({ ...picture(from), overlay: source() }, theme).map(({ text }) => text);
    expect(names).toEqual(["membrane 1", "felt force", "force limit", "paper solver", "friction band", "test"]);
    expect(heights(file, "black").length).toBeGreaterThan(100);
  });
});

describe("force and depth against time", () => {
  const drawn = (
    from: Source,
    off = ["permitted"],
    noDepth = false,
  ): { drawing: TimeDrawing; file: string; names: string[] } => {
    const drawing = new TimeDrawing();
    const hidden = new Hidden("test", off);
    const now = {
      source: from,
      window: window20(from),
      pointed: SPIKE,
      cursor: null,
      hidden,
      noDepth,
      comparison: null,
    };
    drawing.arrange(now, 480, 320, 0);
    const pen = new SvgPen();
    drawing.draw(pen, now, theme);
    const names = timeCurves(now, theme).map(({ text }) => text);
    return { drawing, file: pen.file(480, 320, "white", "", ""), names };
  };

  it("one tick of 20 000 that stands out is drawn at its height", () => {
    const { drawing, file } = drawn(source());
    expect(Math.min(...heights(file, "blue"))).toBeCloseTo(drawing.force.y.px(3), 1);
  });

  it("a curve has its name at its end, inside the plot, and no name is on another one", () => {
    const from = new Source("test", true, 100);
    from.history.push(
      batch(0, 100, 3, {
        depth: () => [1e-3, 1.01e-3, 9e-3],
        axial_force: () => [-0.3, -0.3, 0],
        direction: () => [0, -1, 0, 0, -1, 0, 0, -1, 0],
        axis: () => [0, -1, 0],
        phase: () => [2, 2, 2],
      }),
    );
    const { file, drawing } = drawn(from);
    const places = [...file.matchAll(/<text x="([\d.]+)" y="([\d.]+)"[^>]*>membrane (\d)</g)].map(([, x, y, i]) => ({
      x: Number(x), y: Number(y), i,
    })); // biome-ignore format: one line
    const below = places.filter(({ y }) => y > drawing.depth.top);
    expect(below.map(({ i }) => i).sort()).toEqual(["1", "2", "3"]);
    for (const { y } of below) expect(below.filter((one) => Math.abs(one.y - y) < 11)).toHaveLength(1);
    expect(places.every(({ x }) => x >= drawing.depth.left && x <= drawing.depth.right)).toBe(true);
  });

  it("a curve that is switched off is not drawn, and the axis forgets it", () => {
    const from = source({ ceiling: () => [40] });
    const permitted = /stroke="maroon" stroke-width="1.25"[^>]*stroke-dasharray/;
    const off = drawn(from);
    expect(off.file).not.toMatch(permitted);
    expect(off.drawing.force.y.max).toBeLessThan(5);
    const on = drawn(from, ["membrane 0"]);
    expect(on.file).toMatch(permitted);
    expect(on.drawing.force.y.max).toBeGreaterThanOrEqual(40);
    expect(heights(on.file, "blue")).toEqual([]);
  });

  it("the cursor reads the tick under it", () => {
    const { file } = drawn(source());
    expect(file).toContain(">12.3450 s  active<");
    expect(file).toContain(">3.000 N<");
    expect(file).toContain(">4.938 mm<");
    expect(reading(source(), SPIKE, false)).toContain("membrane 1 4.938 mm, model force 3.000 N");
  });

  it("a blind exercise gets the force under the cursor, and no depth", () => {
    const { file } = drawn(source(), ["permitted"], true);
    expect(file).toContain(">3.000 N<");
    expect(file).not.toContain(">4.938 mm<");
    const words = reading(source(), SPIKE, true);
    expect(words).toContain("membrane 1: model force 3.000 N");
    expect(words).not.toContain("mm");
  });

  it("a pop has a mark that says what the force lost, a fault its shade", () => {
    const from = source({ state: (tick) => [tick > 15_000 ? 3 : 2] });
    from.events.value = [
      {
        kind: "event", what: "pop", membrane: 0, name: "skin", tick: 9000, time: 9, depth: 5e-3,
        force_before: 0.5, force_after: 0.25, drop: 0.25,
      }, // biome-ignore format: one line
    ];
    const { file } = drawn(from);
    expect(file).toContain(">pop −0.25 N<");
    expect(file).toContain('fill="maroon" fill-opacity="0.2"');
    expect(file).toContain(">fault<");
  });

  it("a puncture that the live estimate found has a mark, and the legend says what it means", () => {
    const from = source();
    const found = "puncture found by the estimate";
    const before = drawn(from).file.split('stroke="navy"').length;
    expect(drawn(from).names).not.toContain(found);
    from.punctures.value = [SPIKE];
    expect(drawn(from).names).toContain(found);
    expect(drawn(from).file.split('stroke="navy"').length).toBeGreaterThan(before);
  });

  it("a force that a limit cuts has a shade, and the legend says what it means", () => {
    const { file, names } = drawn(source({ limit: (tick) => [tick > 10_000 ? 3 : 1] }));
    expect(file).toContain(">long-run limit<");
    expect(names).toContain("cut by a limit");
    expect(drawn(source({ limit: () => [1] })).names).not.toContain("cut by a limit"); // growing after arming
    const shades = [...file.matchAll(/<rect [^>]*width="([\d.]+)" [^>]*fill="maroon" fill-opacity="0.22"/g)];
    expect(shades.map(([, width]) => Number(width) > 16)).toEqual([true]);
  });
});
