// One membrane on a line, the model of a scene, and the whole servo step: each with peek, commit and its state.
import { Handle, shown } from "./memory.mjs";
import { withScene } from "./scene.mjs";
import {
  LIMIT_FIELDS, LIMITS, MEMBRANE_TICK, readMembraneTick, readRecord, RECORD, SAMPLE, STATUS, writeSample,
} from "./structs.mjs";

const POSITION = 32; // places in the scratch memory
const AXIS = 56;
const FORCE = 80;

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
    if (!(bytes instanceof Uint8Array)) throw new TypeError(`a state is a Uint8Array, not ${shown(bytes)}`);
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
      return readMembraneTick(memory, at);
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
      if (STATUS[status] === "no_number")
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
      if (typeof limits !== "object" || limits === null)
        throw new TypeError(`limits is an object, as in { max_force: 2 }, not ${shown(limits)}`);
      const at = c.malloc(LIMITS);
      try {
        memory.must(c.punctura_limits_init(at, LIMITS));
        for (const [name, value] of Object.entries(limits)) {
          if (!Object.hasOwn(LIMIT_FIELDS, name))
            throw new Error(`there is no limit ${name}: ${Object.keys(LIMIT_FIELDS).join(", ")}`);
          const [offset, type] = LIMIT_FIELDS[name];
          memory.view[`set${type}`](at + offset, value, true);
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
    #tick(make, sample) {
      if (typeof sample !== "object" || sample === null)
        throw new TypeError(`a sample is { sequence, time, position, axis }, not ${shown(sample)}`);
      const { sequence, time, position, axis, buttons = 0, healthy = true, motorTemperature = 0, thumb = 0 } = sample;
      if (!Number.isSafeInteger(sequence) && typeof sequence !== "bigint")
        throw new TypeError(`sequence is ${shown(sequence)}: it must be a whole number`);
      memory.must(c.punctura_sample_init(sampleAt, SAMPLE));
      const state = healthy ? 1 : 0;
      const count = BigInt(sequence);
      const given = { sequence: count, time, position, axis, buttons, healthy: state, motorTemperature, thumb };
      writeSample(memory, sampleAt, given);
      memory.view.setUint32(recordAt, RECORD, true);
      memory.must(make(this.at, sampleAt, recordAt));
      const record = readRecord(memory, recordAt);
      record.tick = Number(record.tick);
      record.fault = record.fault ? memory.text(c.punctura_fault_text(record.fault)) : "";
      return record;
    }
  }
  return { Proxy1d, Insertion, Servo };
};
