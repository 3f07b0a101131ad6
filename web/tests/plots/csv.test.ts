import { describe, expect, it } from "vitest";
import { csv, exactF32 } from "../../src/plots/csv.ts";
import { Pane } from "../../src/plots/kit/axes.ts";
import { SvgPen } from "../../src/plots/kit/svg_pen.ts";
import type { Theme } from "../../src/plots/kit/theme.ts";
import { drawEnds } from "../../src/plots/names.ts";
import { FIELDS } from "../../src/wire/tick_table.ts";
import { history } from "../support/fill_history.ts";

describe("a table of ticks", () => {
  const run = history(50, 2, {
    depth: (tick) => [tick === 7 ? Number.NaN : 0.1 + tick * 1e-3, -0.25],
    axial_force: () => [-0.1, 0],
    phase: () => [2, 0],
    state: () => [2],
    limit: () => [3],
  });

  it("has every tick, under the names of a recording's columns", () => {
    const lines = csv(run, 3, 45, null).join("").trimEnd().split("\n");
    const head = lines[0]!.split(",");
    expect(lines.length).toBe(1 + 42);
    expect(head.slice(0, 5)).toEqual(["tick", "time_s", "x_m", "y_m", "z_m"]);
    expect(head.indexOf("depth_1_m")).toBeGreaterThan(head.indexOf("direction_0_z"));
    const row = lines[1]!.split(",");
    expect(row.length).toBe(head.length);
    const cells = Object.fromEntries(head.map((name, i) => [name, row[i]]));
    expect(cells).toMatchObject({ tick: "3", time_s: "0.003000000", state: "active", limit: "continuous" });
    expect([cells.phase_0, cells.phase_1, cells.force_0_N]).toEqual(["sliding_in", "outside", "-0.1"]);
  });

  it("has a number or nothing in every cell, for every field of the table", () => {
    const lines = csv(run, 0, 5, null).join("").trimEnd().split("\n");
    const heads = new Set(lines[0]!.split(","));
    for (const field of FIELDS) {
      const head = field.column.replace("{i}", "0").replace("{a}", "x");
      expect(heads.has(head), head).toBe(true);
    }
    expect(lines.slice(1).join("\n")).not.toContain("undefined");
  });

  it("keeps all digits of what was sent", () => {
    const lines = csv(run, 0, 50, 0).join("").trimEnd().split("\n");
    const at = lines[0]!.split(",").indexOf("depth_0_m");
    expect(lines[0]).not.toContain("depth_1_m");
    for (let tick = 0; tick < 50; tick++) {
      const cell = lines[1 + tick]!.split(",")[at]!;
      if (tick === 7) expect(cell).toBe("");
      else expect(Math.fround(Number(cell))).toBe(Math.fround(0.1 + tick * 1e-3));
    }
  });

  it("has the other solver's force only where there is one", () => {
    expect(csv(run, 0, 5, null)[0]).not.toContain("other_f");
    const compared = history(5, 1, { other_force: () => [1, 2, 3] });
    expect(csv(compared, 0, 5, null)[0]).toContain("other_fx_N");
  });

  it("numbers come back as they were, to the last bit", () => {
    for (const value of [0, 1, -0.1, 1 / 3, 1.17549435e-38, 3.4028235e38, 123456.79, 1e-5].map(Math.fround)) {
      expect(Math.fround(Number(exactF32(value)))).toBe(value);
    }
    expect(exactF32(Math.fround(0.1))).toBe("0.1");
    expect(exactF32(Number.NaN)).toBe("");
  });
});

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
