import type { ExerciseGoal, MembraneEvent, MembraneView, ProblemPart, SceneView } from "./messages.ts";

/** The studio's JSON answers about its files. python/punctura/studio makes them. */

/** One entry of `GET /api/recordings`. */
export interface RecordingEntry {
  readonly name: string;
  readonly title: string;
  /** ISO 8601, UTC. */
  readonly started: string;
  readonly seconds: number;
  readonly ticks: number;
  readonly lost: number;
  readonly scene: string;
  /** Name of the exercise; empty if this is not an attempt. */
  readonly exercise: string;
  readonly finished: boolean;
}

/** `GET /api/recordings/NAME`: a recording without its ticks. */
export interface RecordingOverview {
  readonly info: Readonly<Record<string, unknown>>;
  readonly scene: SceneView;
  readonly events: readonly MembraneEvent[];
  readonly ticks: number;
  readonly first_tick: number;
}

/** `GET /api/recordings/NAME/trace`: decimated curves that keep every peak. SI; null is a gap. */
export interface RecordingTrace {
  readonly time: readonly number[];
  /** Depth of the tip below the first surface. */
  readonly depth: readonly (number | null)[];
  /** Size of the model's force, negative if it pulls the needle in. */
  readonly force: readonly (number | null)[];
  readonly membranes: readonly MembraneView[];
}

export const recordingPath = (name: string): string => `/api/recordings/${encodeURIComponent(name)}`;

/** A line that the point must meet. SI. */
export interface GoalLine {
  readonly point: readonly number[];
  /** Its direction, of any length. */
  readonly along: readonly number[];
  readonly within: number;
}

/** One entry of `GET /api/exercises`. SI. */
export interface ExerciseOverview {
  readonly name: string;
  readonly title: string;
  readonly description: string;
  readonly instruction: string;
  readonly scene: string;
  /** The space's name in sentences. */
  readonly space_name: string;
  /** Index of the membrane in front of the target space, and of the membrane behind it if there is one. */
  readonly space: readonly number[];
  /** Distance from the far face of the first membrane to the start of the space, m. */
  readonly space_from: number;
  /** Distance from that face to the end of the space, m; null: the second membrane, or no end. */
  readonly space_to: number | null;
  /** Distance from that face that the tip must reach, m: more than the start of the space if a `reach` goal asks. */
  readonly goal_from: number;
  readonly goals: readonly string[];
  /** The line that the point must meet, m; null without one. */
  readonly line: GoalLine | null;
  /** Name of the recording that is the expert's run; empty without one. */
  readonly expert: string;
  /** It was made in the page, and can be deleted there. */
  readonly made: boolean;
  /** The page shows no needle and no depth while it runs. */
  readonly blind: boolean;
  /** Errors in the file of a user's own exercise. */
  readonly problems: readonly ProblemPart[];
  /** Warnings: allowed values that are usually a mistake. */
  readonly warnings: readonly ProblemPart[];
  /** Why this device cannot show what the student must feel, and what to do; empty if it can. */
  readonly unfelt: string;
  /** What is judged in another way here; may be empty. */
  readonly note: string;
}

/** `GET /api/results/NAME`: see python/punctura/exercise/result.py. SI; null: not available. */
export interface ExerciseResult {
  readonly name: string;
  readonly exercise: string;
  readonly title: string;
  readonly scene: string;
  readonly person: string;
  /** The person's class; missing in results of earlier versions. */
  readonly group?: string;
  /** Name of the recording; empty if the attempt was not recorded. */
  readonly recording: string;
  /** ISO 8601, UTC. */
  readonly date: string;
  readonly passed: boolean;
  /** Why an attempt that achieved everything is not judged as passed; else empty. Missing in earlier results. */
  readonly withheld?: string;
  /** Sentences for the student. */
  readonly reasons: readonly string[];
  readonly goals: readonly ExerciseGoal[];
  readonly metrics: ExerciseMetrics;
  readonly events: readonly Omit<MembraneEvent, "kind">[];
  /** The coach's sentences; missing in results of earlier versions. */
  readonly coaching?: { readonly good: readonly Remark[]; readonly change: readonly Remark[] };
}

/** One sentence of the coach. */
export interface Remark {
  readonly about: string;
  readonly text: string;
}

/** A loss of resistance, as the hand got it. N */
export interface FeltLoss {
  readonly before: number;
  readonly after: number;
  /** The smallest drop that counts as felt; null if the exercise does not need it to be felt. */
  readonly needed: number | null;
}

/** The loss of resistance at a pop. */
export interface Loss extends FeltLoss {
  readonly membrane: number;
  readonly name: string;
}

/** The plunger of the syringe gave way under the thumb. */
export interface Yield {
  /** N, of the thumb, model force. */
  readonly push: number;
  /** m³ in `seconds` after it. */
  readonly injected: number;
  readonly seconds: number;
  /** Null without a second device. */
  readonly loss: FeltLoss | null;
}

export interface ExerciseMetrics {
  readonly entries: number;
  readonly peak_force: number;
  /** Missing in results of earlier versions, as are the next two. */
  readonly peak_felt_force?: number | null;
  readonly force_scale?: number;
  readonly losses?: readonly Loss[];
  readonly overshoot: readonly {
    readonly membrane: number;
    readonly name: string;
    readonly time: number;
    readonly distance: number;
    /** Length of the measurement after the pop, s. */
    readonly seconds: number;
  }[];
  /** Each time that the plunger of the syringe gave way under the thumb; missing in results of earlier versions. */
  readonly yields?: readonly Yield[];
  readonly dwell: number;
  readonly longest_stay: number;
  readonly path_length: number | null;
  readonly net_distance: number | null;
  readonly straightness: number | null;
  readonly lateral_deviation: number | null;
  readonly entry_angle: number | null;
  readonly time_to_target: number | null;
  readonly total_time: number;
  readonly lost_ticks: number;
  /** Time in which each limit cut the device's force, s; missing in results of earlier versions. */
  readonly force_cut?: Readonly<Record<string, number>>;
}

export const resultPath = (name: string): string => `/api/results/${encodeURIComponent(name)}`;

/** A field of the present scene that can be varied: `GET /api/lab/fields`. SI. */
export interface SceneField {
  readonly path: string;
  readonly value: number;
  readonly unit: string;
}

/** A quantity of all compared runs on one axis. SI; null where there is no value. */
export interface LabBand {
  readonly x: readonly number[];
  /** One row for each run. */
  readonly runs: readonly (readonly (number | null)[])[];
  readonly mean: readonly (number | null)[];
  /** Standard deviation, n - 1. */
  readonly deviation: readonly (number | null)[];
  /** The number of runs that have a value. */
  readonly count: readonly number[];
}

export interface LabCurves {
  readonly bands: Readonly<
    Partial<Record<"model" | "felt" | "permitted" | "depth" | "thumb" | "pressure" | "plunger", LabBand>>
  >;
  /** The model's resistance of each membrane; empty if the runs have different membranes. */
  readonly membranes: readonly (LabBand & { readonly name: string })[];
}

export type LabNumber =
  | "duration"
  | "depth"
  | "peak"
  | "felt_peak"
  | "drop"
  | "overshoot"
  | "work"
  | "felt_work"
  | "thumb_peak"
  | "pressure_peak"
  | "plunger_travel";

/** The result of `GET /api/lab/compare`; python/punctura/compare makes it. */
export interface LabComparison {
  readonly statistics: readonly (Readonly<Record<LabNumber, number | null>> & {
    readonly name: string;
    readonly pops: readonly { readonly name: string; readonly time: number; readonly drop: number }[];
  })[];
  /** What each run's numbers have more than the first run's. */
  readonly differences: readonly Readonly<Record<LabNumber, number | null>>[];
  readonly summary: Readonly<
    Record<LabNumber, { readonly n: number; readonly mean: number | null; readonly deviation: number | null }>
  >;
  readonly depth: LabCurves;
  readonly time: LabCurves;
}

/** One line of the answer of `GET /api/lab/compare`. */
export type LabLine =
  | { readonly share: number; readonly run: string }
  | { readonly comparison: LabComparison }
  | { readonly error: string };
