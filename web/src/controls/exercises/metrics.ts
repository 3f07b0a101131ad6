import { degrees } from "../../format.ts";
import { feltForce } from "../../state/scale.ts";
import type { Metrics } from "../../wire/messages.ts";
import { lossText } from "./goals.ts";

/** A row of the result's table: a label, a value and help. */
export interface MetricRow {
  readonly label: string;
  readonly value: string;
  readonly help: string;
}

const NONE = "–";
const seconds = (value: number | null): string => (value === null ? NONE : `${value.toFixed(1)} s`);
const millimetres = (value: number | null): string => (value === null ? NONE : `${(value * 1e3).toFixed(1)} mm`);

/** The peak of the model’s force, for the table and the drawing. */
export const peakText = ({ metrics }: { readonly metrics: Pick<Metrics, "peak_force"> }): string =>
  `${metrics.peak_force.toFixed(2)} N`;

/** The measures of an attempt, with text and units. space: where the exercise leads to. */
export function metricRows(metrics: Metrics, space = "the space"): MetricRow[] {
  const { entry_angle: angle, straightness } = metrics;
  return [
    { label: "Entries", value: String(metrics.entries), help: "Number of entries into the first membrane." },
    {
      label: "Peak model force",
      value: peakText({ metrics }),
      help: "Largest total force of the model.",
    },
    ...(metrics.peak_felt_force === null
      ? []
      : [
          {
            label: `Peak ${feltForce(metrics.force_scale)}`,
            value: `${metrics.peak_felt_force.toFixed(2)} N`,
            help: "Largest force on the hand, after force scale and limits.",
          },
        ]),
    ...metrics.losses.map((loss) => ({
      label: `Loss of resistance felt, ${loss.name}`,
      value: lossText(loss),
      help: "Drop of the force on the hand at this pop.",
    })),
    ...metrics.overshoot.map(({ name, distance, seconds: window }) => ({
      label: `Overshoot after ${name}`,
      value: millimetres(distance),
      help: `Distance that the tip moved on in the ${window} s after this pop.`,
    })),
    ...metrics.yields.flatMap(({ push, injected, seconds: window, loss }) => [
      {
        label: "Thumb when the plunger gave way",
        value: `${push.toFixed(2)} N`,
        help: "Model force of the thumb on the plunger, just before the point came into the space.",
      },
      {
        label: "Loss of resistance felt, plunger",
        value: loss ? lossText(loss) : "none: the thumb was a key or a button of the page",
        help: "Drop of the force that the second device gave the thumb, within 0.3 s.",
      },
      {
        label: "Injected after it",
        value: `${(injected * 1e6).toFixed(1)} mL`,
        help: `Volume that left the syringe in the ${window} s after the plunger gave way.`,
      },
    ]),
    {
      label: `Time in ${space}`,
      value: seconds(metrics.dwell),
      help: "Total time of the tip’s point there; of the whole tip if the goal asks for it.",
    },
    { label: "Longest stay", value: seconds(metrics.longest_stay), help: `Longest time in ${space} without a break.` },
    {
      label: "Path straightness",
      value: straightness === null ? NONE : straightness.toFixed(2),
      help: "Length of the tip’s path divided by the straight distance: 1 is straight.",
    },
    {
      label: "Lateral deviation",
      value: millimetres(metrics.lateral_deviation),
      help: "Largest distance from the line of entry, in the tissue.",
    },
    {
      label: "Angle of entry",
      value: angle === null ? NONE : degrees(Math.round((angle * 180) / Math.PI)),
      help: "Angle between the needle and the first surface.",
    },
    {
      label: `Time to ${space}`,
      value: seconds(metrics.time_to_target),
      help: "From the first contact to the first arrival.",
    },
    { label: "Total time", value: seconds(metrics.total_time), help: "From the first contact to the decision." },
    ...Object.entries(metrics.force_cut).map(([limit, time]) => ({
      label: `Force cut, ${limit}`,
      value: seconds(time),
      help: "Time in which this limit made the felt force smaller.",
    })),
    ...(metrics.lost_ticks > 0
      ? [
          {
            label: "Ticks lost",
            value: String(metrics.lost_ticks),
            help: "Ticks that are missing from the measures.",
          },
        ]
      : []),
  ];
}
