import { expect, test } from "vitest";
import { metricRows } from "../../../src/controls/exercises/metrics.ts";
import type { Loss, Metrics, PlungerLoss, Yield } from "../../../src/wire/messages.ts";

const metrics: Metrics = {
  entries: 2,
  peak_force: 0.9041,
  peak_felt_force: null,
  force_scale: 1,
  losses: [],
  yields: [],
  overshoot: [{ membrane: 0, name: "skin", time: 1, distance: 0.00213, seconds: 0.5 }],
  dwell: 5.26,
  longest_stay: 3.1,
  path_length: null,
  net_distance: null,
  straightness: null,
  lateral_deviation: 0.0001,
  entry_angle: 0.5236,
  time_to_target: null,
  total_time: 21.1,
  lost_ticks: 0,
  force_cut: {},
  page_late: 0,
  computer_late: 0,
  force_off: 0,
};

test("the help of an overshoot names the time in which it was measured", () => {
  expect(metricRows(metrics).find(({ label }) => label.startsWith("Overshoot"))?.help).toContain("in the 0.5 s after");
});

test("the felt force stands beside the model force, with the scale, and each loss of resistance", () => {
  const losses = [
    { membrane: 0, name: "skin", before: 0.4, after: 0.15, needed: null },
    { membrane: 1, name: "wall", before: 0.4, after: 0.36, needed: 0.1 },
  ] as Loss[];
  const told = metricRows({ ...metrics, peak_felt_force: 0.2712, force_scale: 0.3, losses });
  expect(Object.fromEntries(told.map(({ label, value }) => [label, value]))).toMatchObject({
    "Peak model force": "0.90 N",
    "Peak felt force (× 0.30)": "0.27 N",
    "Loss of resistance felt, skin": "0.25 N",
    "Loss of resistance felt, wall": "0.04 N; 0.1 N needed",
  });
  expect(metricRows(metrics).some(({ label }) => label.includes("felt"))).toBe(false);
});

test("the thumb is told each time that the plunger gave way", () => {
  const yields = [{ push: 3.996, injected: 0.94e-6, seconds: 1, loss: null }] as Yield[];
  const rows = new Map(metricRows({ ...metrics, yields }).map(({ label, value }) => [label, value]));
  expect(rows.get("Thumb when the plunger gave way")).toBe("4.00 N");
  expect(rows.get("Injected after it")).toBe("0.9 mL");
  expect(metricRows(metrics).some(({ label }) => label.includes("plunger"))).toBe(false);
});

test("what the thumb felt is told, or that it was a key or a button", () => {
  const gave = { push: 4, push_after: null, injected: 0, seconds: 1, time: 0 };
  const loss = { before: 0.22, after: 0.1, needed: 0.1 } as PlungerLoss;
  const felt = (one: typeof loss | null) =>
    metricRows({ ...metrics, yields: [{ ...gave, loss: one }] }).find(({ label }) => label.endsWith("felt, plunger"));
  expect(felt(loss)?.value).toBe("0.12 N; 0.1 N needed");
  expect(felt(null)?.value).toBe("none: the thumb was a key or a button of the page");
});

test("measures are told in units for people; what there was not is a dash", () => {
  const rows = new Map(metricRows(metrics, "the vein").map(({ label, value }) => [label, value]));
  expect(Object.fromEntries(rows)).toMatchObject({
    Entries: "2",
    "Peak model force": "0.90 N",
    "Overshoot after skin": "2.1 mm",
    "Path straightness": "–",
    "Angle of entry": "30 degrees",
    "Time to the vein": "–",
  });
  expect(rows.has("Ticks lost")).toBe(false);
  const cut = metricRows({ ...metrics, force_cut: { "long-run limit": 1.24 } }).at(-1);
  expect(cut).toMatchObject({ label: "Force cut, long-run limit", value: "1.2 s" });
  expect(metricRows({ ...metrics, lost_ticks: 3 }).at(-1)).toMatchObject({ label: "Ticks lost", value: "3" });
});
