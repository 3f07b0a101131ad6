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
export interface Scene {
  name?: string;
  /** m, rad */
  needle: { diameter: number; tip_angle: number; direction?: "stylus" | "motion" };
  /** N/m, N s/m */
  coupling: { stiffness: number; damping: number; relaxation?: { stiffness: number; time_constant: number }[] };
  /** Hz */
  servo?: { rate?: number; low_pass?: number; solver?: "exact" | "paper"; [more: string]: unknown };
  membrane: Membrane[];
}

/** One needle through all membranes of a scene. The force is the model's, without the limits of a device. */
export interface Insertion {
  /** One tick. Tip, m, and direction of the needle. Returns the force on the needle, N.
   *  RangeError: not finite. */
  step(position: Triple, axis: Triple): [number, number, number];
  /** Clears the state. */
  reset(): void;
  /** Gives the memory back. */
  free(): void;
}

/** One membrane on a line, K06 section 3.1. */
export interface Proxy1d {
  /** One tick. Depth of the device, m. Returns the force on it, N, positive inward.
   *  RangeError: not finite, or beyond 1000 km. */
  step(depth: number): number;
  reset(): void;
  free(): void;
}

export interface Punctura {
  version: string;
  /** scene: an object, or lines `path = value`. Error: all problems of the scene, one a line, with their paths. */
  Insertion: new (scene: Scene | string) => Insertion;
  /** membrane: its number in the scene, from 0. */
  Proxy1d: new (scene: Scene | string, membrane?: number) => Proxy1d;
}

/** Loads the module. source: its URL or its bytes; without it, punctura.wasm beside this file. */
export function load(source?: string | URL | BufferSource): Promise<Punctura>;
