/** The force of a needle that goes through tissue membranes, in WebAssembly. SI units. */

export type Triple = ArrayLike<number>;

/** One membrane: what K06 needs. More keys: those of docs/c-abi.md, for example `grip` and `tip_length`. */
export interface Membrane {
  name?: string;
  /** N/m */
  stiffness: number;
  /** N */
  precompression: number;
  friction: number;
  /** m */
  thickness: number;
  /** any point of the surface, m */
  point: number[];
  /** a direction of any length but 0 */
  inward_normal: number[];
  [more: string]: unknown;
}

/** A scene with the names of the C library. A number that is missing has its default, or is an error. */
export interface SceneValues {
  name?: string;
  /** m, rad */
  needle: { diameter: number; tip_angle: number; direction?: "stylus" | "motion" };
  /** N/m, N s/m */
  coupling: { stiffness: number; damping: number; relaxation?: { stiffness: number; time_constant: number }[] };
  /** Hz */
  servo?: { rate?: number; low_pass?: number; solver?: "exact" | "paper"; [more: string]: unknown };
  membrane: Membrane[];
  [more: string]: unknown;
}

/**
 * The text of a scene file (TOML); an object in SI units; or lines `path = value` in SI units, as
 * `punctura.fmu.description.scene_file_text(scene)` writes them in Python.
 */
export type Scene = string | SceneValues | { lines: string };

/** A problem of a scene: its place, the value (NaN if it is no number), and the reason. */
export interface Problem {
  path: string;
  value: number;
  reason: string;
}
/** The message has all problems, one a line. */
export class PuncturaError extends Error {
  readonly problems: readonly Problem[];
}

export type Phase = "outside" | "sticking" | "sliding_in" | "sliding_out" | "barred";

/** One membrane in the last tick. */
export interface MembraneTick {
  phase: Phase;
  /** m, of the band */
  depth: number;
  /** N, along the needle */
  axialForce: number;
  /** the friction band, N */
  lower: number;
  upper: number;
  /** m */
  proxy: [number, number, number];
  /** of the needle at entry; valid while inside */
  direction: [number, number, number];
}

interface Stepper {
  /** Makes the tick that the last peek has computed. */
  commit(): void;
  /** The complete state, to continue later with the same bits. Other bytes are refused. */
  state: Uint8Array;
  /** Clears the state. */
  reset(): void;
  /** Gives the memory back. A later use throws. */
  free(): void;
}

/** One membrane on a line, K06 section 3.1. RangeError: a depth that is not finite, or beyond 1000 km. */
export interface Proxy1d extends Stepper {
  /** One tick. Depth of the device, m. Returns the force on it, N, positive inward. */
  step(depth: number): number;
  /** The force of that tick, without making it. */
  peek(depth: number): number;
  membrane(): MembraneTick;
}

/** One needle through all membranes of a scene. The force is the model's, without the limits of a device. */
export interface Insertion extends Stepper {
  /** One tick. Tip, m, and direction of the needle. Returns the force on the needle, N. RangeError: not finite. */
  step(position: Triple, axis: Triple): [number, number, number];
  /** The force of that tick, without making it. */
  peek(position: Triple, axis: Triple): [number, number, number];
  membrane(index: number): MembraneTick;
}

/** docs/safety.md. The defaults are for a PHANTOM Omni. N, s, m/s. */
export interface Limits {
  max_force?: number;
  continuous_force?: number;
  continuous_time?: number;
  ramp_time?: number;
  warm_motor?: number;
  max_speed?: number;
  stale?: number;
  deadline?: number;
  axis_tolerance?: number;
  /** bits of the dead-man buttons; 0 needs none */
  dead_man?: number;
}

/** The reading of a device in a tick. */
export interface Sample {
  /** number of the reading: an equal number is the same reading */
  sequence: number;
  /** start of the tick, s, on a clock that never goes back */
  time: number;
  /** of the tip, m */
  position: Triple;
  /** direction of the needle, of length 1 */
  axis: Triple;
  buttons?: number;
  /** false: the device reports a fault */
  healthy?: boolean;
  /** 1 is the maker's danger limit */
  motorTemperature?: number;
  /** depth of the thumb on the plunger, m */
  thumb?: number;
}

export interface Record {
  tick: number;
  state: "disarmed" | "waiting" | "active" | "faulted";
  /** what happened, and what to do; "" without a fault */
  fault: string;
  /** what made the force smaller */
  limit: "none" | "ramp" | "peak" | "continuous" | "temperature";
  membraneCount: number;
  /** the conditioned position, m */
  tip: [number, number, number];
  /** N, without scale and limits */
  modelForce: [number, number, number];
  /** N, for the device. 0 unless the state is active. */
  force: [number, number, number];
  forceScale: number;
  /** the largest force that all limits permit in this tick, N */
  ceiling: number;
  /** N, for the device under the thumb, before its own limits */
  thumbForce: number;
  /** m, N, Pa, m^3; NaN without a syringe */
  plunger: number;
  plungerForce: number;
  pressure: number;
  left: number;
}

/** The whole tick for a device: input gate, model, force scale, force limits. Read docs/safety.md first. */
export interface Servo extends Stepper {
  /** Requests force. It starts, with a ramp, when the tip is in front of every membrane. */
  arm(): void;
  disarm(): void;
  step(sample: Sample): Record;
  peek(sample: Sample): Record;
  membrane(index: number): MembraneTick;
}

export interface Pose {
  /** m */
  position: [number, number, number];
  axis: [number, number, number];
}

/** A scene as the studio's page draws it: SceneView in python/punctura/studio/wire/common.py, without `tables`. */
export interface LiveScene {
  number: number;
  name: string;
  diameter: number;
  tip_length: number;
  direction: string;
  solver: string;
  rate: number;
  force_scale: number;
  membranes: {
    name: string;
    point: [number, number, number];
    inward_normal: [number, number, number];
    thickness: number;
    look: string;
    behind: string;
  }[];
  laws: LiveLaw[];
  lumen: number[];
  syringe: { bore: number; volume: number } | null;
}
export interface LiveLaw {
  name: string;
  obliquity: number;
  far_face: number;
  through: number;
  depth: number[];
  lower: number[];
  upper: number[];
}

/** Messages of the studio's page: python/punctura/studio/wire/messages.py. */
export type LiveMessage =
  | {
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
  | { kind: "laws"; laws: LiveLaw[] }
  | {
      kind: "estimate";
      on: boolean;
      phase: "free" | "rise" | "behind";
      slope: { value: number; half: number } | null;
      plateau: { value: number; half: number } | null;
      punctures: number;
      drop: number;
      ignored: number;
      found: { tick: number; depth: number }[];
    };

/**
 * A scene on a simulated PHANTOM Omni in a simulated hand: the run of the studio's page without a server. Ticks come in
 * blocks, on a clock of their own at the scene's rate. The device takes part with its limits and its encoders.
 */
export interface LiveRun {
  /** Requests force. It starts, with a ramp, when the tip is in front of every membrane. */
  arm(): void;
  /** Ends the force; ticks continue. */
  pause(): void;
  /** Clears a fault; disarmed. */
  reset(): void;
  /** The next reading of the device has a position that is not a number. */
  trip(): void;
  /** Where the hand moves: position, m; direction of the stylus, of any length but 0. */
  target(position: Triple, axis: Triple, buttons?: number): void;
  /** Strokes through all membranes and back, until the next target. period: s, in and out. */
  strokes(period: number): void;
  readonly strokesNow: boolean;
  /** A simulated thumb pushes the plunger, N. */
  pushPlunger(force: number): void;
  /** The frames get the other solver's force on the same samples, too. */
  compare(on: boolean): void;
  estimate(on: boolean): void;
  /** Exchanges the scene between two ticks; the force fades over. Error: then nothing has changed. */
  exchange(scene: Scene): void;
  /** Makes `count` ticks. Returns their frame: python/punctura/studio/wire/frames.py has its bytes. */
  advance(count: number): ArrayBuffer;
  /** Makes one tick with this reading in place of the simulated device's. */
  feed(position: Triple, axis: Triple): ArrayBuffer;
  /** Hz */
  readonly rate: number;
  /** The target of the hand. */
  readonly pose: Pose;
  readonly scene: LiveScene;
  /** The messages since the last call. */
  messages(): LiveMessage[];
  free(): void;
}

export interface LiveOptions {
  /** of the run, for its frames; 0 by default */
  number?: number;
  /** of tremor and encoders; 0 by default */
  seed?: number;
  /** of the hand; by default in front of all membranes */
  pose?: { position: Triple; axis: Triple };
  /** the run before: its motors do not cool because a new run begins */
  after?: LiveRun;
}

export interface Punctura {
  version: string;
  /** membrane: its number in the scene, from 0. */
  Proxy1d: new (scene: Scene, membrane?: number) => Proxy1d;
  Insertion: new (scene: Scene) => Insertion;
  Servo: new (scene: Scene, limits?: Limits) => Servo;
  LiveRun: {
    new (scene: Scene, options?: LiveOptions): LiveRun;
    /** The simulated device and the limits of every LiveRun. */
    readonly about: {
      device: {
        backend: string;
        model: string;
        simulated: boolean;
        has_orientation: boolean;
        max_force: number;
        rate: number;
      };
      limits: Required<Omit<Limits, "dead_man">> & { dead_man_buttons: number[] };
    };
  };
  /** The tables of a TOML text as they are written; null if it is not TOML. */
  tablesOf(toml: string): { [key: string]: unknown } | null;
}

/** Loads the module. source: its URL or its bytes; without it, punctura.wasm beside this file, or embedded.mjs. */
export function load(source?: string | URL | BufferSource): Promise<Punctura>;
