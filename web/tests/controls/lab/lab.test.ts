import { describe, expect, it } from "vitest";
import { sceneForm } from "../../../src/controls/editor/fields.ts";
import { drawLab, labCurves, quantitiesOf } from "../../../src/controls/lab/drawing.ts";
import { plateauWords, slopeWords } from "../../../src/controls/lab/estimate.ts";
import { fieldWords, runWords, shortNames, shownUnit } from "../../../src/controls/lab/fields.ts";
import { bundlePath, compute, queryOf } from "../../../src/controls/lab/job.ts";
import { choose } from "../../../src/controls/lab/pick.ts";
import { stretches } from "../../../src/plots/band_mean.ts";
import { Hidden } from "../../../src/plots/kit/legend.ts";
import { SvgPen } from "../../../src/plots/kit/svg_pen.ts";
import { CSS_THEME } from "../../../src/plots/kit/theme.ts";
import { Api } from "../../../src/wire/api.ts";
import type { LabBand, LabComparison } from "../../../src/wire/messages.ts";
import schema from "../support/schema.json";

const band = (...runs: number[][]): LabBand => ({
  x: [0, 1e-3, 2e-3],
  runs,
  mean: [0, 1, 2],
  deviation: [0, 0.5, null],
  count: [2, 2, 1],
});
const numbers = {
  duration: 1, depth: 1, peak: 1, felt_peak: 1, drop: 1, overshoot: null, work: 1, felt_work: 1,
  thumb_peak: null, pressure_peak: null, plunger_travel: null,
}; // biome-ignore format: a table
const some = { n: 2, mean: 1, deviation: 0 };
const none = { n: 0, mean: null, deviation: null };
const curves = { bands: { model: band([0, 1, 2], [0, 2, 4]), depth: band([0, 1, 2], [0, 2, 4]) }, membranes: [] };
const comparison: LabComparison = {
  statistics: ["Ann", "Ben"].map((name) => ({ name, pops: [], ...numbers })),
  differences: [numbers, numbers],
  summary: {
    duration: some, depth: some, peak: some, felt_peak: some,
    drop: some, overshoot: some, work: some, felt_work: some,
    thumb_peak: none, pressure_peak: none, plunger_travel: none,
  }, // biome-ignore format: a table
  depth: curves,
  time: curves,
};

/** Answers every request with these pieces of a body. */
const answering = (...pieces: string[]): Api => {
  const body = new ReadableStream<Uint8Array>({
    start: (to) => {
      for (const piece of pieces) to.enqueue(new TextEncoder().encode(piece));
      to.close();
    },
  });
  return new Api("", () => Promise.resolve(new Response(body)));
};
const never = new AbortController().signal;

describe("a comparison", () => {
  it("is asked for by the names of recordings, or by a field, its values and a motion", () => {
    expect(queryOf({ recordings: ["a b", "c&d"] })).toBe("run=a+b&run=c%26d");
    const job = { path: "membrane[0].stiffness", from: 1, to: 2, count: 3 };
    expect(queryOf({ ...job, motion: 0.005 })).toBe("path=membrane%5B0%5D.stiffness&from=1&to=2&count=3&speed=0.005");
    expect(queryOf({ ...job, motion: "Ann" })).toContain("motion=Ann");
    expect(bundlePath({ ...job, motion: 0.005, id: "x1" }, "time")).toContain("&id=x1&on=time");
  });

  it("draws the mean only where two runs or more have a value, and breaks it where a run ends", () => {
    const counted = (...count: number[]): LabBand => ({ x: [], runs: [], mean: [], deviation: [], count });
    expect(stretches(counted(2, 2, 1))).toEqual([[0, 2]]);
    expect(stretches(counted(1, 3, 3, 2, 1, 0))).toEqual([
      [1, 3],
      [3, 4],
    ]);
    expect(stretches(counted(0, 1))).toEqual([]);
  });

  it("offers the plunger only if a run has a syringe, with its units", () => {
    expect(quantitiesOf(comparison).map(([name]) => name)).toEqual(["model"]);
    const pressed = { ...curves, bands: { ...curves.bands, pressure: band([0, 1e4, 2e4], [0, 1e4, 3e4]) } };
    const syringe = { ...comparison, depth: pressed, time: pressed };
    expect(quantitiesOf(syringe).map(([name]) => name)).toEqual(["model", "pressure"]);
    const pen = new SvgPen();
    drawLab(pen, 600, 380, CSS_THEME, syringe, "depth", "pressure", new Hidden(null));
    expect(pen.file(600, 380, "white", "", "")).toContain("pressure in the syringe (kPa)");
  });

  it("names a field by its membrane, and a varied run by its value alone", () => {
    expect(fieldWords("membrane[1].tip_length", ["skin", "vein wall"])).toBe("2 vein wall: tip length");
    expect(fieldWords("needle.diameter", [])).toBe("needle: diameter");
    expect(fieldWords("membrane[0].inward_normal[1]", ["skin"])).toBe("1 skin: inward normal y");
    expect(shortNames(["a.b = 1 N", "a.b = 2 N"])).toEqual(["1 N", "2 N"]);
    expect(shortNames(["a.b = 1 N", "Ben"])).toEqual(["a.b = 1 N", "Ben"]);
    expect(shortNames(["a.b = 1 N"])).toEqual(["a.b = 1 N"]);
  });

  it("has the names and the units of the editor, and other names as they are", () => {
    const names = ["skin"];
    expect(runWords("membrane[0].stiffness = 285 N/m", names)).toBe("1 skin: stiffness = 0.285 N/mm");
    expect(runWords("membrane[0].point[1] = -0.001 m", names)).toBe("1 skin: point y = -1 mm");
    expect(runWords("needle.tip_angle = 0.209440 rad", names)).toBe("needle: tip angle = 12 degrees");
    expect(runWords("membrane[0].friction = 1e-06 -", names)).toBe("1 skin: friction = 0.000001");
    for (const name of ["Ann", "a = 3", "2026-11-29 skin = 4 N"]) expect(runWords(name, names)).toBe(name);
  });

  it("varies each quantity in a unit that a field of the editor has", () => {
    const tables = sceneForm(schema).tables.flatMap(({ fields }) => fields.map(({ unit }) => unit));
    for (const si of ["m", "rad", "N/m", "N s/m", "1/m", "N", "Hz"]) expect(tables).toContain(shownUnit(si)[0]);
  });

  it("has the first chosen run as its reference, wherever it stands in the list", () => {
    const second = choose(choose([], "b", true), "a", true);
    expect(second).toEqual(["b", "a"]);
    expect(choose(choose(second, "b", false), "b", true)).toEqual(["a", "b"]);
  });

  it("tells its progress while lines come in pieces, then gives the result", async () => {
    const shares: number[] = [];
    const api = answering(
      '{"share": 0, "run": "Ann"}\n{"sha',
      `re": 0.5, "run": "Ben"}\n{"comparison": ${JSON.stringify(comparison)}}\n`,
    );
    const found = await compute(api, { recordings: [] }, (share) => shares.push(share), never);
    expect(shares).toEqual([0, 0.5]);
    expect(found).toEqual(comparison);
  });

  it("that fails says why, and so does one that ends early", async () => {
    const job = { recordings: [] };
    await expect(compute(answering('{"error": "too long"}\n'), job, () => {}, never)).rejects.toThrow("too long");
    await expect(compute(answering(""), job, () => {}, never)).rejects.toThrow("no result");
  });

  it("is drawn with each run, their mean and its deviation; the legend switches each of them off", () => {
    const drawn = (off: string[], on: "depth" | "time" = "depth"): string => {
      const pen = new SvgPen();
      drawLab(pen, 600, 300, CSS_THEME, comparison, on, "model", new Hidden("test", off));
      return pen.file(600, 300, "none", "", "");
    };
    const lines = (file: string): number => file.match(/stroke-width="1\.4"/g)?.length ?? 0;
    expect(labCurves(comparison, CSS_THEME).map(({ id }) => id)).toEqual(["run 0", "run 1", "mean"]);
    expect(lines(drawn([]))).toBe(2);
    expect(drawn([])).toContain('fill-opacity="0.18"');
    expect(lines(drawn(["run 1", "mean"]))).toBe(1);
    expect(drawn(["mean"])).not.toContain('fill-opacity="0.18"');
    expect(lines(drawn([], "time"))).toBe(4); // the force, and the depth below it
    expect(drawn([], "time")).toContain(">time since the first contact (s)<");
  });
});

describe("the live estimate", () => {
  it("is told with units and the half of its 95 % interval", () => {
    expect(slopeWords({ value: 212.34, half: 11.8 })).toBe("0.212 ± 0.012 N/mm");
    expect(plateauWords({ value: 0.41024, half: 0.0021 })).toBe("0.410 ± 0.002 N");
  });

  it("is a dash while it is not known", () => {
    expect([slopeWords(null), plateauWords(null)]).toEqual(["–", "–"]);
  });
});
