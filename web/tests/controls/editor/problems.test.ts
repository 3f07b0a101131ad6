import { expect, test } from "vitest";
import { sceneForm } from "../../../src/controls/editor/fields.ts";
import { boundProblem, sortProblems } from "../../../src/controls/editor/problems.ts";
import schema from "../support/schema.json";

const shown = new Set(["membrane[1].friction", "membrane[0].point_mm", "needle.tip_angle_deg"]);

test("a problem is shown at the field that caused it, all others at the top", () => {
  const { fields, others } = sortProblems(
    [
      { path: "membrane[1].friction", value: "3.6", reason: "the largest value that is allowed is 3.477, K06 (7)" },
      { path: "membrane[0].point_mm[2]", value: "x", reason: "must be a number" },
      { path: "servo.rate_hz", value: "0", reason: "must be greater than 0" },
      { path: "membrane[0].stiffness_N_per_mm", value: "0", reason: "must be greater than 0" },
      { path: "membrane[2].point_mm[1]", value: "x", reason: "must be a number" },
      { path: "coupling.relaxation_time_constant_s", value: "0", reason: "must be greater than 0" },
      { path: "goal[0].within_deg", value: "46", reason: "must be at most 45 deg, at least 0.1 deg" },
      { path: "", value: "", reason: "membrane[1].tail_length_mm needs a tail" },
    ],
    shown,
  );
  expect(fields.get("membrane[1].friction")).toBe("The largest value that is allowed is 3.477.");
  expect(fields.get("membrane[0].point_mm")).toBe("Must be a number.");
  expect(others).toEqual([
    "servo, rate = 0: Must be greater than 0.",
    "membrane 1, stiffness = 0: Must be greater than 0.",
    "membrane 3, point y = x: Must be a number.",
    "coupling, relaxation time constant = 0: Must be greater than 0.",
    "goal[0].within_deg = 46: Must be at most 45 degrees, at least 0.1 degrees.",
    "Membrane 2, tail length needs a tail.",
  ]);
});

test("a broken bound of the schema is reported before sending", () => {
  const needle = sceneForm(schema).tables[0]!;
  const angle = needle.fields.find(({ key }) => key === "tip_angle_deg")!;
  expect(boundProblem(angle, 90)).toContain("between 0 and pi/2");
  expect(boundProblem(angle, 11)).toBeNull();
});
