import { expect, it } from "vitest";
import { Pane } from "../../src/plots/kit/axes.ts";
import { SvgPen } from "../../src/plots/kit/svg_pen.ts";
import type { Theme } from "../../src/plots/kit/theme.ts";
import { drawEnds } from "../../src/plots/names.ts";

it("a name stands above the end of its curve, so that no level curve strikes it out, and inside the pane", () => {
  const pane = new Pane();
  pane.place(0, 0, 300, 100);
  const pen = new SvgPen();
  const ends = [60, 3].map((y) => ({ x: 100, y, text: `at ${y}`, colour: "navy" }));
  drawEnds(pen, pane, ends, { panel: "white" } as Theme);
  const heights = [...pen.file(300, 100, "white", "", "").matchAll(/<text x="[\d.]+" y="([\d.]+)"/g)].map(([, y]) =>
    Number(y),
  );
  expect(heights[0]).toBeLessThan(60 - 11.5 / 2);
  expect(heights[1]).toBeGreaterThan(11.5 / 2);
});
