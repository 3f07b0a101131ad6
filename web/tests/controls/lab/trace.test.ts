import { describe, expect, it } from "vitest";
import {
  answersOf,
  columnWords,
  isComplaints,
  sceneNeedle,
  statedUnit,
} from "../../../src/controls/lab/trace/asked.ts";
import { drawTrace, type Other, traceCurves } from "../../../src/controls/lab/trace/drawing.ts";
import { type FieldError, identify, LARGEST, lookAt, queryOf, refusalOf } from "../../../src/controls/lab/trace/job.ts";
import {
  doubtWords,
  estimateWords,
  fitWords,
  parameterWords,
  rankWords,
} from "../../../src/controls/lab/trace/words.ts";
import { Hidden } from "../../../src/plots/kit/legend.ts";
import { SvgPen } from "../../../src/plots/kit/svg_pen.ts";
import { CSS_THEME } from "../../../src/plots/kit/theme.ts";
import { Api } from "../../../src/wire/api.ts";
import type { EstimatePart, FileLine, IdentifyLine, RivalRow } from "../../../src/wire/messages.ts";

const FILE: FileLine = {
  kind: "file",
  name: "a.csv",
  rows: 3,
  columns: [
    { name: "z", unit: "", examples: [0, -0.00123456] },
    { name: "load_kN", unit: "kN", examples: [] },
  ],
  roles: [
    { role: "depth", needed: true, column: "", units: ["m", "mm"] },
    { role: "force", needed: true, column: "load_kN", units: ["N", "kN"] },
    { role: "time", needed: false, column: "", units: ["s"] },
  ],
  needle: null,
};
const TYPED = {
  columns: { depth: "z", force: "load_kN", time: "" },
  units: { depth: "mm", force: "kN", time: "" },
  digitised: false,
  diameter: "1,2",
  angle: "20",
  membranes: "auto",
};
const never = new AbortController().signal;

/** Answers a request with these lines, and keeps what was asked. */
const answering = (seen: [string, RequestInit][], ...lines: (IdentifyLine | "")[]): Api =>
  new Api("", (path, init) => {
    seen.push([path, init!]);
    return Promise.resolve(new Response(lines.map((line) => (line ? JSON.stringify(line) : "")).join("\n")));
  });

describe("the questions about a file", () => {
  it("ask for what the file does not state, each at its field, and guess nothing", () => {
    const none = answersOf(FILE, { ...TYPED, columns: {}, units: {}, diameter: "", angle: "20 deg" });
    expect(Object.keys(none)).toEqual(["column.depth", "column.force", "diameter_mm", "tip_angle_deg"]);
    const [depth] = FILE.roles;
    expect(statedUnit(FILE, depth!, "z")).toBe("");
    expect(statedUnit(FILE, depth!, "load_kN")).toBe(""); // a force is no depth
    expect(answersOf(FILE, { ...TYPED, units: { force: "kN" } })).toEqual({
      "unit.depth": "Choose the unit of the depth: the file does not state it.",
    });
  });

  it("show the first numbers of each column, and take the needle of the running scene", () => {
    expect(FILE.columns.map(columnWords)).toEqual(["z: 0, −0.00123 …", "load_kN"]);
    expect(sceneNeedle({ diameter: 1e-3, tip_length: 1e-3 })).toEqual({ diameter: "1", angle: "45" });
  });

  it("become the request, with no time if none was chosen", () => {
    const answers = answersOf(FILE, TYPED);
    if (isComplaints(answers)) throw new Error(JSON.stringify(answers));
    expect(queryOf("a b.csv", answers)).toBe(
      "name=a+b.csv&diameter_mm=1.2&tip_angle_deg=20&membranes=auto&order=recorded" +
        "&column=depth%3Dz&column=force%3Dload_kN&column=time%3D&unit=depth%3Dmm&unit=force%3DkN",
    );
  });

  it("are not asked for a scene file, an empty file or one that is too large", () => {
    expect(refusalOf({ name: "a.toml", size: 9 })).toContain("in the tab Scene");
    expect(refusalOf({ name: "a.csv", size: 0 })).toContain("empty");
    expect(refusalOf({ name: "a.csv", size: LARGEST + 1 })).toContain("at most 32 MB");
    expect(refusalOf({ name: "a.csv", size: LARGEST })).toBe("");
  });
});

describe("a file that is sent", () => {
  const file = new File(["1,2"], "a.csv");

  it("goes as the body of a POST, and its lines come one by one, empty ones left out", async () => {
    const seen: [string, RequestInit][] = [];
    const words: string[] = [];
    const wait: IdentifyLine = { kind: "step", words: "waiting", share: null };
    const answer = answering(seen, "", wait, FILE);
    expect(await lookAt(answer, file, never, (told) => words.push(told))).toEqual({ file: FILE, trace: null });
    expect(words).toEqual(["waiting"]);
    expect(seen[0]![0]).toBe("/api/lab/file?name=a.csv");
    expect(seen[0]![1]).toMatchObject({ method: "POST", body: file });
  });

  it("tells the field of an error, after the lines before it", async () => {
    const step: IdentifyLine = { kind: "step", words: "K06", share: null };
    const wrong: IdentifyLine = { kind: "error", text: "No unit.", field: "unit.depth" };
    const answers = answersOf(FILE, TYPED);
    if (isComplaints(answers)) throw new Error("no answers");
    const lines: IdentifyLine[] = [];
    const all = async (): Promise<void> => {
      for await (const line of identify(answering([], step, wrong), file, answers, never)) lines.push(line);
    };
    await expect(all()).rejects.toMatchObject({
      message: "No unit.",
      field: "unit.depth",
    } satisfies Partial<FieldError>);
    expect(lines).toEqual([step]);
  });
});

const estimate = (more: Partial<EstimatePart>): EstimatePart => ({
  name: "membrane[0].stiffness",
  value: 605.7,
  low: 598.5,
  high: 612.9,
  unit: "N/m",
  identifiable: true,
  ...more,
});
const rival = (title: string, aic: number | null, own = false): RivalRow => ({
  name: title, title, parameters: 7, rmse: 0.01, rmse_share: 0.012, aic, bic: null, held_out_rmse: null, rest: null,
  converged: true, own, force: [],
}); // biome-ignore format: a row

describe("the result in words", () => {
  it("names parameters as the scene editor does, with the digits that the interval allows", () => {
    expect(parameterWords("membrane[1].friction")).toBe("Membrane 2: friction");
    expect(parameterWords("tissue.growth")).toBe("All membranes: growth of the grip");
    expect(parameterWords("coupling_stiffness")).toBe("Spring between needle and tissue");
    expect(estimateWords(estimate({}))).toEqual({
      value: "0.6057 N/mm",
      interval: "0.5985 to 0.6129",
      relative: "± 1.2 %",
    });
    expect(estimateWords(estimate({ low: null })).interval).toBe("less than 0.6129");
    expect(estimateWords(estimate({ low: null, high: null })).interval).toBe("any value");
    expect(estimateWords(estimate({ name: "offset", value: -3e-4, low: -9e-4, high: 3e-4 })).value).toBe("−0.30 mN");
  });

  it("says what the trace cannot tell in the same words", () => {
    expect(doubtWords("membrane[0].thickness is not identifiable from this trace: sample faster.")).toBe(
      "Membrane 1: thickness is not identifiable from this trace: sample faster.",
    );
    expect(doubtWords("cutting and set are not identifiable from one insertion: insert again.")).toBe(
      "Cutting and set are not identifiable from one insertion: insert again.",
    );
  });

  it("says how well K06 follows the trace, and which model fits best, also where that is another", () => {
    expect(fitWords({ membranes: 1, extensions: [], rmse: 0.01, rmse_share: 0.0119, explained: true })).toBe(
      "K06 with one membrane follows the force to 10 mN rms, 1.2 % of its peak.",
    );
    const wrong = fitWords({ membranes: 2, extensions: ["tail"], rmse: 0.2, rmse_share: 0.05, explained: false });
    expect(wrong).toContain("K06 with tail and 2");
    expect(wrong).toContain("of its peak, but does not explain the trace: see below.");
    expect(rankWords({ rows: [rival("K06", -9, true), rival("Dahl", -5)] })).toContain("Of 2 models it fits best");
    expect(rankWords({ rows: [rival("Dahl", -9), rival("K06", -5, true)] })).toMatch(/^Dahl fits better/);
    expect(rankWords({ rows: [rival("K06", null, true), rival("Dahl", null)] })).toBe("");
  });
});

describe("the plot of a trace", () => {
  const curves = {
    depth: [0, 1e-3, 2e-3, 1e-3],
    force: [0, 1, 0.5, -0.5],
    time: [0, 1, 2, 3],
    model: [0, 1.1, 0.5, -0.4],
  };
  const drawn = (against: "depth" | "time", model = true, off: string[] = [], other: Other | null = null): string => {
    const pen = new SvgPen();
    const shown = { ...curves, model: model ? curves.model : null };
    const trace = { contact: 0, pops: [1e-3] };
    drawTrace(pen, 600, 400, CSS_THEME, { trace, curves: shown, other, against }, new Hidden("test", off));
    return pen.file(600, 400, "none", "", "");
  };

  it("has the trace, then the fit and what is left, each of which the legend switches off", () => {
    expect(traceCurves({ curves: { ...curves, model: null }, other: null }, CSS_THEME).map(({ id }) => id)).toEqual([
      "measured",
    ]);
    expect(traceCurves({ curves, other: null }, CSS_THEME).map(({ id }) => id)).toEqual([
      "measured",
      "model",
      "residual",
    ]);
    expect(drawn("depth", false)).not.toContain("model − measured");
    expect(drawn("depth")).toContain("model − measured (N)");
    expect(drawn("depth")).toContain(">pop<");
    expect(drawn("time")).toContain(">time (s)<");
    const lines = (file: string): number => file.match(/<path /g)?.length ?? 0;
    expect(lines(drawn("depth")) - lines(drawn("depth", true, ["model", "residual"]))).toBe(2);
  });

  it("can have another model beside the fit", () => {
    const other = { title: "Dahl", force: [0, 2, 0, 0] };
    expect(traceCurves({ curves, other }, CSS_THEME).map(({ text }) => text)).toContain("Dahl");
    expect(drawn("depth", true, [], other)).toContain('stroke-dasharray="6 4"');
    expect(drawn("depth", true, ["other"], other)).not.toContain('stroke-dasharray="6 4"');
  });
});
