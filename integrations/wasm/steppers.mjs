// One membrane on a line, the model of a scene, and the whole servo step: each with peek, commit and its state.
import { Handle } from "./memory.mjs";
import { withScene } from "./scene.mjs";

const NO_NUMBER = 5; // PUNCTURA_NO_NUMBER
const POSITION = 32; // places in the scratch memory
const AXIS = 56;
const FORCE = 80;
// Sizes of the structs of punctura.h in wasm32. The library refuses a smaller one.
const LIMITS = 88;
const SAMPLE = 96;
const RECORD = 160;
const MEMBRANE_TICK = 88;

const PHASES = ["outside", "sticking", "sliding_in", "sliding_out", "barred"];
const STATES = ["disarmed", "waiting", "active", "faulted"];
const LIMITED_BY = ["none", "ramp", "peak", "continuous", "temperature"];
const LIMIT_FIELDS = [
  "max_force", "continuous_force", "continuous_time", "ramp_time", "warm_motor", "max_speed", "stale", "deadline",
  "axis_tolerance",
];

/** What all three have. kind: the name in the functions of punctura.h. */
class Stepper {
  #memory;
  #kind;
  #handle;
  constructor(memory, kind, scene, ...choice) {
    this.#memory = memory;
    this.#kind = kind;
    const at = withScene(memory, scene, (description) =>
      memory.made((to) => this.call("new", description, ...choice, to)),
    );
    this.#handle = new Handle(at, memory.c[`punctura_${kind}_free`]);
  }
  call(what, ...given) {
    return this.#memory.c[`punctura_${this.#kind}_${what}`](...given);
  }
  get at() {
    return this.#handle.at;
  }
  free() {
    this.#handle.free();
  }
  reset() {
    this.#memory.must(this.call("reset", this.at));
  }
  commit() {
    this.#memory.must(this.call("commit", this.at));
  }
  get state() {
    const size = this.call("state_size", this.at);
    return this.#memory.withMemory(size, (at) => {
      this.#memory.must(this.call("save", this.at, at, size));
      return new Uint8Array(this.#memory.bytes(at, size));
    });
  }
  set state(bytes) {
    this.#memory.withMemory(Math.max(1, bytes.length), (at) => {
      new Uint8Array(this.#memory.c.memory.buffer).set(bytes, at);
      this.#memory.must(this.call("restore", this.at, at, bytes.length));
    });
  }
  /** The last tick of one membrane. */
  membrane(...index) {
    const memory = this.#memory;
    return memory.withMemory(MEMBRANE_TICK, (at) => {
      memory.view.setUint32(at, MEMBRANE_TICK, true);
      if (this.call("membrane", this.at, ...index, at))
        throw new RangeError(`the scene has no membrane ${index[0]}`);
      const number = (k) => memory.view.getFloat64(at + k, true);
      return {
        phase: PHASES[memory.view.getInt32(at + 4, true)],
        depth: number(8),
        axialForce: number(16),
        lower: number(24),
        upper: number(32),
        proxy: memory.triple(at + 40),
        direction: memory.triple(at + 64),
      };
    });
  }
}

export const steppersOf = (memory) => {
  const { c, scratch } = memory;

  class Proxy1d extends Stepper {
    constructor(scene, membrane = 0) {
      super(memory, "proxy1d", scene, membrane);
    }
    step(depth) {
      return this.#force(c.punctura_proxy1d_step(this.at, depth), depth);
    }
    peek(depth) {
      return this.#force(c.punctura_proxy1d_peek(this.at, depth), depth);
    }
    #force(force, depth) {
      if (Number.isNaN(force))
        throw new RangeError(`depth is ${depth}: it must be a finite number of metres, below 1e6`);
      return force;
    }
  }

  class Insertion extends Stepper {
    constructor(scene) {
      super(memory, "insertion", scene);
    }
    step(position, axis) {
      return this.#tick(c.punctura_insertion_step, position, axis);
    }
    peek(position, axis) {
      return this.#tick(c.punctura_insertion_peek, position, axis);
    }
    #tick(make, position, axis) {
      memory.put(position, scratch + POSITION);
      memory.put(axis, scratch + AXIS);
      const status = make(this.at, scratch + POSITION, scratch + AXIS, scratch + FORCE);
      if (status === NO_NUMBER)
        throw new RangeError(
          `position is [${position}] and axis is [${axis}]: they must be finite, a position below 1e6 m, an axis not 0`,
        );
      memory.must(status);
      return memory.triple(scratch + FORCE);
    }
  }

  const sampleAt = c.malloc(SAMPLE);
  const recordAt = c.malloc(RECORD);

  class Servo extends Stepper {
    constructor(scene, limits = {}) {
      const at = c.malloc(LIMITS);
      try {
        memory.must(c.punctura_limits_init(at, LIMITS));
        for (const [name, value] of Object.entries(limits)) {
          const k = LIMIT_FIELDS.indexOf(name);
          if (name === "dead_man") memory.view.setUint32(at + 80, value, true);
          else if (k < 0) throw new Error(`there is no limit ${name}: dead_man, ${LIMIT_FIELDS.join(", ")}`);
          else memory.view.setFloat64(at + 8 + 8 * k, value, true);
        }
        super(memory, "servo", scene, at);
      } finally {
        c.free(at);
      }
    }
    arm() {
      memory.must(c.punctura_servo_arm(this.at));
    }
    disarm() {
      memory.must(c.punctura_servo_disarm(this.at));
    }
    step(sample) {
      return this.#tick(c.punctura_servo_step, sample);
    }
    peek(sample) {
      return this.#tick(c.punctura_servo_peek, sample);
    }
    #tick(make, { sequence, time, position, axis, buttons = 0, healthy = true, motorTemperature = 0, thumb = 0 }) {
      memory.must(c.punctura_sample_init(sampleAt, SAMPLE));
      const { view } = memory;
      view.setBigUint64(sampleAt + 8, BigInt(sequence), true);
      view.setFloat64(sampleAt + 16, time, true);
      memory.put(position, sampleAt + 24);
      memory.put(axis, sampleAt + 48);
      view.setUint32(sampleAt + 72, buttons, true);
      view.setInt32(sampleAt + 76, healthy ? 1 : 0, true);
      view.setFloat64(sampleAt + 80, motorTemperature, true);
      view.setFloat64(sampleAt + 88, thumb, true);
      view.setUint32(recordAt, RECORD, true);
      memory.must(make(this.at, sampleAt, recordAt));
      const number = (k) => view.getFloat64(recordAt + k, true);
      const code = (k) => view.getInt32(recordAt + k, true);
      const fault = code(20);
      return {
        tick: Number(view.getBigUint64(recordAt + 8, true)),
        state: STATES[code(16)],
        fault: fault ? memory.text(c.punctura_fault_text(fault)) : "",
        limit: LIMITED_BY[code(24)],
        tip: memory.triple(recordAt + 32),
        modelForce: memory.triple(recordAt + 56),
        force: memory.triple(recordAt + 80),
        forceScale: number(104),
        ceiling: number(112),
        thumbForce: number(120),
        plunger: number(128),
        plungerForce: number(136),
        pressure: number(144),
        left: number(152),
      };
    }
  }
  return { Proxy1d, Insertion, Servo };
};
