// Made by npm run types, from the models of python/punctura/studio/wire_schema.py.

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
  | SittingMessage
  | Reply
  | Notice;
export type Request =
  | TakeControl
  | Arm
  | Pause
  | Reset
  | Target
  | Awake
  | Took
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
  | Respond
  | TripFault;
export type IdentifyLine = FileLine | StepLine | TraceLine | FitLine | RivalsLine | ReportLine | ErrorLine;
export type LabLine = LabProgress | LabResult | LabFailure;
export type Answer =
  | RecordingEntry
  | RecordingOverview
  | RecordingTrace
  | ExerciseOverview
  | SceneOutline
  | Result
  | SceneField;

export interface Wire {
  message: Message;
  request: Request;
  identify_line: IdentifyLine;
  lab_line: LabLine;
  answer: Answer;
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
  syringe: SyringeView | null;
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
  what: "touch" | "pop" | "out";
  membrane: number;
  name: string;
  tick: number;
  time: number;
  depth: number;
  force_before: number;
  force_after: number;
  drop: number;
  kind: "event";
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
 * The state of an exercise; `running` is false without one and after its end. Times in tenths.
 */
export interface ExerciseStatus {
  instruction: string;
  goals: GoalState[];
  held: number;
  hold: number;
  time: number;
  time_limit: number | null;
  kind: "exercise";
  exercise: string;
  running: boolean;
  result: string;
  blind: boolean;
}
/**
 * A goal as a sentence, and its state.
 *
 * At the end a limit that was kept is met, if it was measured; else it is `not measured`, and a reason says why. What
 * was not decided is open.
 */
export interface GoalState {
  text: string;
  state: "open" | "met" | "missed" | "not measured";
}
/**
 * A participant's session (docs/perception.md): the page shows one sentence, and takes the answers.
 */
export interface SittingMessage {
  kind: "sitting";
  question: number;
  sentence: string;
  answers: AnswerKey[];
  any_number: boolean;
  covered: boolean;
  noise: boolean;
}
/**
 * An answer that is possible now.
 */
export interface AnswerKey {
  name: string;
  key: string;
}
/**
 * The reply to the request with this id.
 */
export interface Reply {
  kind: "reply";
  id: number;
  ok: boolean;
  text: string;
  problems: ProblemPart[];
  data: {
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
 * The page has taken a message with ticks. From its first `took` on, few are on the way. No reply.
 */
export interface Took {
  do: "took";
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
 * The answer to a question of a participant's session. One to another question is ignored.
 */
export interface Respond {
  id: number;
  do: "respond";
  question: number;
  answer: string;
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
  verdicts: string[];
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
  field: string;
}
/**
 * The run that is computed now, and the share of the work that is done.
 */
export interface LabProgress {
  share: number;
  run: string;
}
/**
 * The last line.
 */
export interface LabResult {
  comparison: LabComparison;
}
/**
 * A comparison against depth and against time.
 */
export interface LabComparison {
  statistics: Statistics[];
  differences: {
    [k: string]: number | null;
  }[];
  summary: {
    [k: string]: Summary;
  };
  depth: LabCurves;
  time: LabCurves;
}
/**
 * The numbers of a run. SI.
 */
export interface Statistics {
  name: string;
  duration: number;
  depth: number;
  peak: number;
  felt_peak: number | null;
  work: number;
  felt_work: number | null;
  thumb_peak: number | null;
  pressure_peak: number | null;
  plunger_travel: number | null;
  drop: number;
  overshoot: number | null;
  pops: Pop[];
}
/**
 * A pop of a run. SI.
 */
export interface Pop {
  membrane: number;
  name: string;
  time: number;
  drop: number;
  felt_drop: number | null;
  overshoot: number | null;
}
/**
 * A number over several runs. SI; None where there are too few runs.
 */
export interface Summary {
  n: number;
  mean: number | null;
  deviation: number | null;
}
/**
 * The curves of a comparison, as Comparison has them.
 */
export interface LabCurves {
  bands: {
    [k: string]: LabBand;
  };
  membranes: MembraneBand[];
}
/**
 * A quantity of all runs, and its mean, on a common axis. SI, with DIGITS digits; None where there is no value.
 */
export interface LabBand {
  x: number[];
  runs: (number | null)[][];
  mean: (number | null)[];
  deviation: (number | null)[];
  count: number[];
}
/**
 * The resistance of a membrane.
 */
export interface MembraneBand {
  x: number[];
  runs: (number | null)[][];
  mean: (number | null)[];
  deviation: (number | null)[];
  count: number[];
  name: string;
}
/**
 * The last line of a computation that failed.
 */
export interface LabFailure {
  error: string;
}
/**
 * One entry of the list of recordings.
 */
export interface RecordingEntry {
  name: string;
  title: string;
  started: string;
  seconds: number;
  ticks: number;
  lost: number;
  scene: string;
  exercise: string;
  finished: boolean;
}
/**
 * A recording without its ticks.
 */
export interface RecordingOverview {
  scene: SceneView;
  events: MembraneEvent[];
  ticks: number;
  first_tick: number;
}
/**
 * A drawing of a recording. None: a gap.
 */
export interface RecordingTrace {
  time: number[];
  depth: (number | null)[];
  force: (number | null)[];
  tip: number;
  membranes: MembraneView[];
}
/**
 * An exercise as the page lists it. SI.
 */
export interface ExerciseOverview {
  name: string;
  title: string;
  description: string;
  instruction: string;
  scene: string;
  space_name: string;
  space: number[];
  space_from: number;
  space_to: number | null;
  goal_from: number;
  line: GoalLine | null;
  expert: string;
  made: boolean;
  blind: boolean;
  /**
   * @minItems 3
   * @maxItems 3
   */
  start_position: [number, number, number];
  /**
   * @minItems 3
   * @maxItems 3
   */
  start_axis: [number, number, number];
  goals: string[];
  problems: ProblemPart[];
  warnings: ProblemPart[];
  unfelt: string;
  note: string;
}
/**
 * The line of an on_line goal.
 */
export interface GoalLine {
  /**
   * @minItems 3
   * @maxItems 3
   */
  point: [number, number, number];
  /**
   * @minItems 3
   * @maxItems 3
   */
  along: [number, number, number];
  within: number;
}
/**
 * A ready scene for the making of an exercise. SI.
 */
export interface SceneOutline {
  name: string;
  title: string;
  tip_length: number;
  syringe: boolean;
  membranes: MembraneView[];
}
/**
 * A result; punctura.exercise.results saves it. `name` is the name of the saved file, empty before.
 */
export interface Result {
  format: number;
  name: string;
  exercise: string;
  title: string;
  scene: string;
  person: string;
  group: string;
  recording: string;
  date: string;
  version: string;
  passed: boolean;
  withheld: string;
  reasons: string[];
  goals: GoalState[];
  metrics: Metrics;
  events: Event[];
  coaching: Coaching;
}
/**
 * Measures up to the decision (overshoots: to the end of their seconds), SI. None: not available.
 */
export interface Metrics {
  entries: number;
  peak_force: number;
  peak_felt_force: number | null;
  force_scale: number;
  losses: Loss[];
  yields: Yield[];
  overshoot: Overshoot[];
  dwell: number;
  longest_stay: number;
  path_length: number | null;
  net_distance: number | null;
  straightness: number | null;
  lateral_deviation: number | null;
  entry_angle: number | null;
  time_to_target: number | null;
  total_time: number;
  lost_ticks: number;
  force_cut: {
    [k: string]: number;
  };
  page_late: number;
  force_off: number;
}
/**
 * The loss of resistance at a pop. Forces are along the needle.
 *
 * before: at the membrane's largest resistance, as far as the limits permitted it until the pop. after: at the pop.
 */
export interface Loss {
  before: number;
  after: number;
  model_before: number;
  model_after: number;
  force_scale: number;
  needed: number | null;
  membrane: number;
  name: string;
  time: number;
}
/**
 * The plunger of the syringe gave way under the thumb. Forces are the model's on the thumb, N.
 */
export interface Yield {
  time: number;
  push: number;
  push_after: number | null;
  loss: PlungerLoss | null;
  injected: number;
  seconds: number;
}
/**
 * The loss of resistance at the plunger, from a second device. Forces are on the thumb.
 *
 * before: in the last tick before the point came out behind the membrane. after: the least in the time of a hand's
 * reaction after the plunger gave way, for a thumb that is not drawn back.
 */
export interface PlungerLoss {
  before: number;
  after: number;
  model_before: number;
  model_after: number;
  force_scale: number;
  needed: number | null;
  name: string;
  drawn_back: boolean;
}
/**
 * How far the tip moved on behind a membrane in the seconds after its pop.
 */
export interface Overshoot {
  membrane: number;
  name: string;
  time: number;
  distance: number;
  seconds: number;
}
/**
 * An event, in SI units. Forces are the model's, along the needle, before safety limits. Only a pop has forces.
 */
export interface Event {
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
 * The coach's words about one attempt, the most important first. Empty if there is nothing to say.
 */
export interface Coaching {
  good: Remark[];
  change: Remark[];
}
export interface Remark {
  about: string;
  text: string;
  numbers: {
    [k: string]: number;
  };
  time: number | null;
}
/**
 * A field of the present scene that can be varied. SI.
 */
export interface SceneField {
  path: string;
  value: number;
  unit: string;
}
