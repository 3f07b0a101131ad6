import type { ExerciseMetrics } from "../../wire/files.ts";

/** A line of the result's table: what, how much, and what that means. */
export interface MetricRow {
  readonly label: string;
  readonly value: string;
  readonly help: string;
}

const NONE = "–";
const seconds = (value: number | null): string => (value === null ? NONE : `${value.toFixed(1)} s`);
const millimetres = (value: number | null): string => (value === null ? NONE : `${(value * 1e3).toFixed(1)} mm`);

/** The peak of the model’s force, as the table and the drawing show it. */
export const peakText = ({ metrics }: { readonly metrics: Pick<ExerciseMetrics, "peak_force"> }): string =>
  `${metrics.peak_force.toFixed(2)} N`;

/** The measures of an attempt in words and units for people. */
export function metricRows(metrics: ExerciseMetrics): MetricRow[] {
  const { entry_angle: angle, straightness } = metrics;
  return [
    { label: "Entries", value: String(metrics.entries), help: "How often the first membrane was entered." },
    {
      label: "Peak model force",
      value: peakText({ metrics }),
      help: "The largest size of the model’s force, all membranes together. A limit may have given the hand less.",
    },
    ...metrics.overshoot.map(({ name, distance, seconds: window }) => ({
      label: `Overshoot after ${name}`,
      value: millimetres(distance),
      help: `How far the tip ran on in the ${window} s after this pop.`,
    })),
    {
      label: "Time in the space",
      value: seconds(metrics.dwell),
      help: "How long the needle was where it should be, in all: the whole tip if the goal asks for it, else the point.",
    },
    { label: "Longest stay", value: seconds(metrics.longest_stay), help: "How long it was there at a time." },
    {
      label: "Path straightness",
      value: straightness === null ? NONE : straightness.toFixed(2),
      help: "Length of the tip’s way over the straight distance: 1 is straight.",
    },
    {
      label: "Off the line of entry",
      value: millimetres(metrics.lateral_deviation),
      help: "The largest distance from the line of entry.",
    },
    {
      label: "Angle of entry",
      value: angle === null ? NONE : `${((angle * 180) / Math.PI).toFixed(0)}°`,
      help: "Between the needle and the first surface.",
    },
    {
      label: "Time to the space",
      value: seconds(metrics.time_to_target),
      help: "From the first touch to the first arrival.",
    },
    { label: "Time in all", value: seconds(metrics.total_time), help: "From the first touch to the decision." },
    ...Object.entries(metrics.force_cut ?? {}).map(([limit, time]) => ({
      label: `Force cut, ${limit}`,
      value: seconds(time),
      help: "How long the device gave less than the model’s force.",
    })),
    ...(metrics.lost_ticks > 0
      ? [
          {
            label: "Ticks lost",
            value: String(metrics.lost_ticks),
            help: "Ticks that never came: the measures lack them.",
          },
        ]
      : []),
  ];
}
