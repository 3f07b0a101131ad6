// Made by npm run types, from python/punctura/studio/wire.

export type Message =
  | Hello
  | SceneMessage
  | LawsMessage
  | Control
  | Status
  | FaultMessage
  | MembraneEvent
  | EstimateMessage
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
  | Awake
  | Strokes
  | PushPlunger
  | PlayMotion
  | Edit
  | Load
  | LoadText
  | Compare
  | Estimate
  | StartRecording
  | StopRecording
  | StartExercise
  | EndExercise
  | SetExpert
  | CheckExercise
  | TryExercise
  | SaveExercise
  | OpenExercise
  | DeleteExercise
  | TripFault;
export type IdentifyLine = FileLine | StepLine | TraceLine | FitLine | RivalsLine | ReportLine | ErrorLine;

export interface Wire {
  message: Message;
  request: Request;
  identify_line: IdentifyLine;
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
  second_device: string;
  limits: LimitsPart;
  scenes: Choice[];
  exercises: Choice[];
  figures: boolean;
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
 * The limits between the model and the hand, for all runs of this studio: docs/safety.md.
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
 * An entry of a list.
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
 * A scene as the page draws it, SI; `tables` has the same scene in the file's keys and units, for the editor.
 */
export interface SceneView {
  number: number;
  name: string;
  diameter: number;
  tip_length: number;
  direction: string;
  solver: string;
  rate: number;
  force_scale: number;
  membranes: MembraneView[];
  laws: LawCurve[];
  tables: {
    [k: string]: unknown;
  };
  lumen: number[];
  syringe?: SyringeView | null;
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
  look:
    | "plain"
    | "skin"
    | "fat"
    | "muscle"
    | "fascia"
    | "ligament"
    | "ligamentum flavum"
    | "dura"
    | "vein wall"
    | "artery wall";
  behind: "tissue" | "blood" | "fat" | "muscle" | "epidural space" | "cerebrospinal fluid";
}
/**
 * Phi_I and Phi_O of one membrane over the depth: K06 (18), (19). All arrays have the same length.
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
 * The syringe of a scene as the page draws it, SI.
 */
export interface SyringeView {
  bore: number;
  volume: number;
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
 * The target of the simulated hand.
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
  second: SecondStatus | null;
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
 * The loop of the device under the thumb.
 */
export interface SecondStatus {
  ticks: number;
  rate: number;
  max_force: number;
  continuous_force: number;
  continuous_time: number;
}
/**
 * A latched fault; cleared when `reason` is empty.
 */
export interface FaultMessage {
  kind: "fault";
  fault: string;
  reason: string;
  remedy: string;
  trouble: string;
  tick: number | null;
  kept: number;
}
/**
 * An event at a membrane.
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
/**
 * The live estimate: what depth and force alone tell. Four times a second while it is on.
 */
export interface EstimateMessage {
  kind: "estimate";
  on: boolean;
  phase: "free" | "rise" | "behind";
  slope: Estimated | null;
  plateau: Estimated | null;
  punctures: number;
  drop: number;
  ignored: number;
  found: FoundPuncture[];
}
/**
 * A value and half of its 95 % interval, SI.
 */
export interface Estimated {
  value: number;
  half: number;
}
/**
 * A puncture that the live estimate found.
 */
export interface FoundPuncture {
  tick: number;
  depth: number;
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
 * The state of an exercise; `running` is false without one and after its end.
 */
export interface ExerciseStatus {
  kind: "exercise";
  exercise: string;
  running: boolean;
  instruction: string;
  goals: ExerciseGoal[];
  result: string;
  blind?: boolean;
  held?: number;
  hold?: number;
  time?: number;
  time_limit?: number | null;
}
export interface ExerciseGoal {
  text: string;
  state: "open" | "met" | "missed" | "not measured";
}
/**
 * The reply to the request with this id.
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
 * One problem of a scene or an exercise: where, and why. punctura.errors.Problem.
 */
export interface ProblemPart {
  path: string;
  value: string;
  reason: string;
}
/**
 * A sentence for the user.
 */
export interface Notice {
  kind: "notice";
  text: string;
}
/**
 * Takes control from the page that has it. All other requests need control.
 */
export interface TakeControl {
  id: number;
  do: "take_control";
}
/**
 * Allows force once the tip is outside tissue.
 */
export interface Arm {
  id: number;
  do: "arm";
}
/**
 * Ends the force; ticks continue.
 */
export interface Pause {
  id: number;
  do: "pause";
}
/**
 * Clears a fault; the loop stays disarmed.
 */
export interface Reset {
  id: number;
  do: "reset";
}
/**
 * Moves the simulated hand. No reply; a later target replaces it; a target of another run is ignored.
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
 * The page can move the hand: about ten times a second while an exercise runs. No reply.
 */
export interface Awake {
  do: "awake";
}
/**
 * The simulated hand strokes through all membranes and back, until the next target.
 */
export interface Strokes {
  id: number;
  do: "strokes";
  period?: number;
}
/**
 * A simulated thumb pushes the plunger of the scene's syringe. It lets go after 1 s without a further request.
 */
export interface PushPlunger {
  id: number;
  do: "push_plunger";
  force: number;
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
 * Exchanges the scene between two ticks; the force fades over. A scene with errors changes nothing.
 */
export interface Edit {
  id: number;
  do: "edit";
  tables: {
    [k: string]: unknown;
  };
}
/**
 * Starts a new run with a ready scene.
 */
export interface Load {
  id: number;
  do: "load";
  scene: string;
}
/**
 * Starts a new run with the text of a scene file.
 */
export interface LoadText {
  id: number;
  do: "load_text";
  toml: string;
}
/**
 * Runs the other solver in parallel, for display only.
 */
export interface Compare {
  id: number;
  do: "compare";
  on: boolean;
}
/**
 * Estimates slope, friction and punctures of the run from depth and force alone, for display only.
 */
export interface Estimate {
  id: number;
  do: "estimate";
  on: boolean;
}
/**
 * Starts a new run and records it, so that it can be replayed bit for bit. The default name is date and scene.
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
 * Starts a recorded run with the exercise's scene.
 */
export interface StartExercise {
  id: number;
  do: "start_exercise";
  exercise: string;
  person?: string;
  group?: string;
}
export interface EndExercise {
  id: number;
  do: "end_exercise";
}
/**
 * Names a recording as the expert's run of an exercise; an empty name removes it.
 */
export interface SetExpert {
  id: number;
  do: "set_expert";
  exercise: string;
  recording?: string;
}
/**
 * Checks the tables of an exercise file. The reply has the text of the file, or the problems.
 */
export interface CheckExercise {
  id: number;
  do: "check_exercise";
  tables: {
    [k: string]: unknown;
  };
}
/**
 * Starts an exercise that was not saved. Its name is `draft`.
 */
export interface TryExercise {
  id: number;
  do: "try_exercise";
  tables: {
    [k: string]: unknown;
  };
  person?: string;
  group?: string;
}
/**
 * Saves an exercise in the user's folder of exercises, under a name without a path.
 */
export interface SaveExercise {
  id: number;
  do: "save_exercise";
  name: string;
  tables: {
    [k: string]: unknown;
  };
  replace?: boolean;
}
/**
 * Checks an exercise file of the page's computer, and keeps it in the user's folder of exercises as it is.
 */
export interface OpenExercise {
  id: number;
  do: "open_exercise";
  name: string;
  file: string;
  replace?: boolean;
}
/**
 * Deletes an exercise that was saved or opened by the page.
 */
export interface DeleteExercise {
  id: number;
  do: "delete_exercise";
  name: string;
}
/**
 * Feeds the gate a position that is not a number, to demonstrate a fault. Simulated device only.
 */
export interface TripFault {
  id: number;
  do: "trip_fault";
}
/**
 * What a file holds. A recording of Punctura states everything, so it has no roles.
 */
export interface FileLine {
  kind: "file";
  name: string;
  rows: number;
  columns: ColumnPart[];
  roles: RolePart[];
  needle: NeedlePart | null;
}
/**
 * A column of a file.
 */
export interface ColumnPart {
  name: string;
  unit: string;
  examples: number[];
}
/**
 * What must be known of a quantity. column: that is clear by its name; empty if none is.
 */
export interface RolePart {
  role: "depth" | "force" | "time";
  needed: boolean;
  column: string;
  units: string[];
}
export interface NeedlePart {
  diameter: number;
  tip_angle: number;
}
/**
 * The step that is computed now.
 */
export interface StepLine {
  kind: "step";
  words: string;
  share: number | null;
}
/**
 * The trace as it was read, before a fit.
 */
export interface TraceLine {
  kind: "trace";
  name: string;
  samples: number;
  peak: number;
  contact: number | null;
  pops: number[];
  curves: CurvesPart;
  findings: FindingPart[];
}
/**
 * Samples of a trace, thinned so that every peak stays. All lists have the same length.
 */
export interface CurvesPart {
  depth: number[];
  force: number[];
  time: number[] | null;
  model: number[] | null;
}
/**
 * Something unusual in the trace.
 */
export interface FindingPart {
  kind: string;
  text: string;
  repaired: boolean;
  severe: boolean;
}
/**
 * The identified membranes.
 */
export interface FitLine {
  kind: "fit";
  membranes: number;
  extensions: string[];
  rmse: number;
  rmse_share: number;
  effective_samples: number;
  curves: CurvesPart;
  estimates: EstimatePart[];
  not_told: string[];
  tried: TriedPart[];
  scene: string;
  no_scene: string;
}
/**
 * A parameter and its 95 % interval; null where the trace sets no bound.
 */
export interface EstimatePart {
  name: string;
  value: number;
  low: number | null;
  high: number | null;
  unit: string;
  identifiable: boolean;
}
/**
 * A model that was tried. The criteria count independent samples.
 */
export interface TriedPart {
  membranes: number;
  extensions: string[];
  parameters: number;
  rmse: number;
  held_out_rmse: number | null;
  aicc: number | null;
  bic: number;
}
/**
 * All models on the trace, the one with the least AIC first.
 */
export interface RivalsLine {
  kind: "rivals";
  rows: RivalRow[];
  notes: string[];
}
/**
 * A force model on the trace. null: no value.
 */
export interface RivalRow {
  name: string;
  title: string;
  parameters: number;
  rmse: number;
  rmse_share: number;
  aic: number | null;
  bic: number | null;
  held_out_rmse: number | null;
  rest: number | null;
  converged: boolean;
  own: boolean;
  force: number[];
}
/**
 * The one-page report, as the text of an HTML file.
 */
export interface ReportLine {
  kind: "report";
  html: string;
}
/**
 * The computation has ended without a result. field: the field of the page with the wrong value, or empty.
 */
export interface ErrorLine {
  kind: "error";
  text: string;
  field?: string;
}
