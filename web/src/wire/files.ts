import type { ExerciseGoal, MembraneEvent, MembraneView, ProblemPart, SceneView } from "./messages.ts";

/** What the studio's files say of themselves, as JSON: python/punctura/studio has their making. */

/** `GET /api/recordings`, one of them. */
export interface RecordingEntry {
  readonly name: string;
  readonly title: string;
  /** ISO 8601, UTC. */
  readonly started: string;
  readonly seconds: number;
  readonly ticks: number;
  readonly lost: number;
  readonly scene: string;
  /** Empty: it was no attempt at an exercise. */
  readonly exercise: string;
  readonly finished: boolean;
}

/** `GET /api/recordings/NAME`: what comes before the ticks. */
export interface RecordingOverview {
  readonly info: Readonly<Record<string, unknown>>;
  readonly scene: SceneView;
  readonly events: readonly MembraneEvent[];
  readonly ticks: number;
  readonly first_tick: number;
}

/** `GET /api/recordings/NAME/trace`: thinned, with every peak. SI; null breaks the curves. */
export interface RecordingTrace {
  readonly time: readonly number[];
  /** Of the tip below the first surface. */
  readonly depth: readonly (number | null)[];
  /** The size of the model's force, negative where it pulls the needle in. */
  readonly force: readonly (number | null)[];
  readonly membranes: readonly MembraneView[];
}

export const recordingPath = (name: string): string => `/api/recordings/${encodeURIComponent(name)}`;

/** `GET /api/exercises`, one of them. SI. */
export interface ExerciseOverview {
  readonly name: string;
  readonly title: string;
  readonly description: string;
  readonly instruction: string;
  readonly scene: string;
  /** The membrane, by its place in the scene, behind which one is to come; if there is one, that in front of which. */
  readonly space: readonly number[];
  /** Where the space begins behind the far face of the first, m. */
  readonly space_from: number;
  /** Where it ends, likewise; null: nowhere, or at the second membrane. */
  readonly space_to: number | null;
  /** How deep the needle must come, likewise: deeper than where the space begins if a `reach` goal says so. */
  readonly goal_from: number;
  readonly goals: readonly string[];
  /** What is wrong with the file of an exercise of one's own; empty where it is sound. */
  readonly problems: readonly ProblemPart[];
  /** What the file may say, but seldom means. */
  readonly warnings: readonly ProblemPart[];
}

/** `GET /api/results/NAME`: python/punctura/exercise/result.py. SI; null: there was none. */
export interface ExerciseResult {
  readonly name: string;
  readonly exercise: string;
  readonly title: string;
  readonly scene: string;
  readonly person: string;
  /** Empty: it was not recorded. */
  readonly recording: string;
  /** ISO 8601, UTC. */
  readonly date: string;
  readonly passed: boolean;
  /** Sentences for the student. */
  readonly reasons: readonly string[];
  readonly goals: readonly ExerciseGoal[];
  readonly metrics: ExerciseMetrics;
  readonly events: readonly Omit<MembraneEvent, "kind">[];
}

export interface ExerciseMetrics {
  readonly entries: number;
  readonly peak_force: number;
  readonly overshoot: readonly {
    readonly membrane: number;
    readonly name: string;
    readonly time: number;
    readonly distance: number;
    /** s after the pop, in which it was measured. */
    readonly seconds: number;
  }[];
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
  /** s in which a limit cut the force to the device, by limit; results of earlier versions do not say. */
  readonly force_cut?: Readonly<Record<string, number>>;
}

export const resultPath = (name: string): string => `/api/results/${encodeURIComponent(name)}`;
