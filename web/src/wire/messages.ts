// Made by npm run types, from python/punctura/studio/wire.

export type Message =
  | Hello
  | SceneMessage
  | LawsMessage
  | Control
  | Status
  | FaultMessage
  | MembraneEvent
  | RecordingStatus
  | ExerciseStatus
  | Reply
  | Notice;
export type Request =
  | TakeControl
  | Arm
  | Pause
  | Reset
  | Target
  | Strokes
  | PlayMotion
  | Edit
  | Load
  | LoadText
  | Compare
  | StartRecording
  | StopRecording
  | StartExercise
  | EndExercise
  | TripFault;

export interface Wire {
  message: Message;
  request: Request;
}
/**
 * First on every connection.
 */
export interface Hello {
  kind: "hello";
  protocol: number;
  version: string;
  viewer: number;
  device: DevicePart;
  limits: LimitsPart;
  scenes: Choice[];
  exercises: Choice[];
  notes: string[];
}
export interface DevicePart {
  backend: string;
  model: string;
  simulated: boolean;
  has_orientation: boolean;
  max_force: number;
  rate: number;
}
/**
 * The limits between the model and the hand, as all runs of this studio have them: docs/safety.md.
 */
export interface LimitsPart {
  max_force: number;
  continuous_force: number;
  continuous_time: number;
  ramp_time: number;
  warm_motor: number;
  max_speed: number;
  stale: number;
  deadline: number;
  axis_tolerance: number;
  dead_man_buttons: number[];
}
/**
 * Something to pick from a list.
 */
export interface Choice {
  name: string;
  title: string;
}
/**
 * After hello, and whenever the scene changes.
 */
export interface SceneMessage {
  kind: "scene";
  scene: SceneView;
  new_run: boolean;
  run: number;
}
/**
 * A scene as the page draws it, SI; `tables` is the same scene as its file has it, for the editor.
 */
export interface SceneView {
  number: number;
  name: string;
  diameter: number;
  tip_length: number;
  direction: string;
  solver: string;
  rate: number;
  membranes: MembraneView[];
  laws: LawCurve[];
  tables: {
    [k: string]: unknown;
  };
  lumen: number[];
}
/**
 * One membrane as the page draws it, SI.
 */
export interface MembraneView {
  name: string;
  /**
   * @minItems 3
   * @maxItems 3
   */
  point: [number, number, number];
  /**
   * @minItems 3
   * @maxItems 3
   */
  inward_normal: [number, number, number];
  thickness: number;
}
/**
 * Phi_I and Phi_O of one membrane along the depth: K06 (18), (19). Arrays of one length.
 */
export interface LawCurve {
  name: string;
  obliquity: number;
  far_face: number;
  through: number;
  depth: number[];
  lower: number[];
  upper: number[];
}
/**
 * The laws for another direction of the needle.
 */
export interface LawsMessage {
  kind: "laws";
  laws: LawCurve[];
}
export interface Control {
  kind: "control";
  holder: number | null;
  you: boolean;
  hand: HandPose | null;
}
/**
 * Where the simulated hand is led to.
 */
export interface HandPose {
  /**
   * @minItems 3
   * @maxItems 3
   */
  position: [number, number, number];
  /**
   * @minItems 3
   * @maxItems 3
   */
  axis: [number, number, number];
}
/**
 * The loop's health, four times a second.
 */
export interface Status {
  kind: "status";
  ticks: number;
  late: number;
  lost: number;
  period: Spread;
  compute: Spread;
  viewers: number;
  dropped: number;
  armed: boolean;
  hand: "target" | "strokes" | "motion" | "device";
  compare: boolean;
  statements: string[];
}
/**
 * A distribution of times, s.
 */
export interface Spread {
  p50: number;
  p99: number;
  p99_9: number;
  largest: number;
  edges: number[];
  counts: number[];
}
/**
 * A latched fault; cleared when `reason` is empty.
 */
export interface FaultMessage {
  kind: "fault";
  fault: string;
  reason: string;
  trouble: string;
  tick: number | null;
  kept: number;
}
/**
 * Something that happened at a membrane.
 */
export interface MembraneEvent {
  kind: "event";
  what: "touch" | "pop" | "out";
  membrane: number;
  name: string;
  tick: number;
  time: number;
  depth: number;
  force_before: number;
  force_after: number;
  drop: number;
}
export interface RecordingStatus {
  kind: "recording";
  name: string;
  rows: number;
  lost: number;
  seconds: number;
  trouble: string;
}
/**
 * How an exercise goes; `running` is false without one and after its end.
 */
export interface ExerciseStatus {
  kind: "exercise";
  exercise: string;
  running: boolean;
  instruction: string;
  goals: ExerciseGoal[];
  result: string;
}
export interface ExerciseGoal {
  text: string;
  state: "open" | "met" | "missed" | "not measured";
}
/**
 * To one request, by its id.
 */
export interface Reply {
  kind: "reply";
  id: number;
  ok: boolean;
  text?: string;
  problems?: ProblemPart[];
  data?: {
    [k: string]: string | number;
  };
}
/**
 * One thing wrong with a scene: where, and why. punctura.errors.Problem.
 */
export interface ProblemPart {
  path: string;
  value: string;
  reason: string;
}
/**
 * A sentence for the person.
 */
export interface Notice {
  kind: "notice";
  text: string;
}
/**
 * Control, from whoever has it. Everything below needs it.
 */
export interface TakeControl {
  id: number;
  do: "take_control";
}
/**
 * Force, once the tip is outside tissue.
 */
export interface Arm {
  id: number;
  do: "arm";
}
/**
 * No force; ticks go on.
 */
export interface Pause {
  id: number;
  do: "pause";
}
/**
 * Leaves a fault; disarmed.
 */
export interface Reset {
  id: number;
  do: "reset";
}
/**
 * Where the simulated hand shall go. Not answered; the last one counts; one of another run is ignored.
 */
export interface Target {
  do: "target";
  run: number;
  /**
   * @minItems 3
   * @maxItems 3
   */
  position: [number, number, number];
  /**
   * @minItems 3
   * @maxItems 3
   */
  axis: [number, number, number];
  buttons?: number;
}
/**
 * The simulated hand strokes to and fro through all membranes, until the next target.
 */
export interface Strokes {
  id: number;
  do: "strokes";
  period?: number;
}
/**
 * The simulated hand follows a recording's tip, until its end or the next target.
 */
export interface PlayMotion {
  id: number;
  do: "play_motion";
  recording: string;
}
/**
 * Another scene in place of the present one, taken between two ticks and faded in. A bad one changes nothing.
 */
export interface Edit {
  id: number;
  do: "edit";
  tables: {
    [k: string]: unknown;
  };
}
/**
 * A ready scene by name, as a new run.
 */
export interface Load {
  id: number;
  do: "load";
  scene: string;
}
/**
 * A scene file's text, as a new run.
 */
export interface LoadText {
  id: number;
  do: "load_text";
  toml: string;
}
/**
 * Runs the other solver beside the present one, for the eye only.
 */
export interface Compare {
  id: number;
  do: "compare";
  on: boolean;
}
/**
 * Records from a new run on, so that it can be run again to the last bit. Without a name it gets date and time.
 */
export interface StartRecording {
  id: number;
  do: "start_recording";
  name?: string | null;
}
export interface StopRecording {
  id: number;
  do: "stop_recording";
}
/**
 * A new run with the exercise's scene, recorded.
 */
export interface StartExercise {
  id: number;
  do: "start_exercise";
  exercise: string;
  person?: string;
}
export interface EndExercise {
  id: number;
  do: "end_exercise";
}
/**
 * Makes the gate see a position that is no number: to try what a fault is like. Simulated device only.
 */
export interface TripFault {
  id: number;
  do: "trip_fault";
}
