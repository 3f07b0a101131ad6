import type { MembraneEvent, SceneView } from "./messages.ts";

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

export const recordingPath = (name: string): string => `/api/recordings/${encodeURIComponent(name)}`;
