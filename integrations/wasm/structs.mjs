// Made by tools/make_c_bindings.py, from punctura.h.
// In wasm32. memory: Memory of memory.mjs.
export const STATUS = ["ok", "bad_argument", "bad_scene", "bad_state", "no_peek", "no_number", "no_memory", "not_built", "internal"];
export const PHASE = ["outside", "sticking", "sliding_in", "sliding_out", "barred"];
export const SERVO_STATE = ["disarmed", "waiting", "active", "faulted"];
export const LIMIT = ["none", "ramp", "peak", "continuous", "temperature"];
export const MEMBRANE_TICK = 88; // bytes
export const readMembraneTick = (memory, at, { view } = memory) => ({
  phase: PHASE[view.getInt32(at + 4, true)],
  depth: view.getFloat64(at + 8, true),
  axialForce: view.getFloat64(at + 16, true),
  lower: view.getFloat64(at + 24, true),
  upper: view.getFloat64(at + 32, true),
  proxy: memory.triple(at + 40),
  direction: memory.triple(at + 64),
});
export const LIMITS = 88; // bytes
/** Offset and type. */
export const LIMIT_FIELDS = {
  max_force: [8, "Float64"],
  continuous_force: [16, "Float64"],
  continuous_time: [24, "Float64"],
  ramp_time: [32, "Float64"],
  warm_motor: [40, "Float64"],
  max_speed: [48, "Float64"],
  stale: [56, "Float64"],
  deadline: [64, "Float64"],
  axis_tolerance: [72, "Float64"],
  dead_man: [80, "Uint32"],
};
export const SAMPLE = 96; // bytes
export const writeSample = (memory, at, from) => {
  const { view } = memory;
  view.setBigUint64(at + 8, from.sequence, true);
  view.setFloat64(at + 16, from.time, true);
  memory.put(from.position, at + 24);
  memory.put(from.axis, at + 48);
  view.setUint32(at + 72, from.buttons, true);
  view.setInt32(at + 76, from.healthy, true);
  view.setFloat64(at + 80, from.motorTemperature, true);
  view.setFloat64(at + 88, from.thumb, true);
};
export const RECORD = 160; // bytes
export const readRecord = (memory, at, { view } = memory) => ({
  tick: view.getBigUint64(at + 8, true),
  state: SERVO_STATE[view.getInt32(at + 16, true)],
  fault: view.getInt32(at + 20, true),
  limit: LIMIT[view.getInt32(at + 24, true)],
  membraneCount: view.getUint32(at + 28, true),
  tip: memory.triple(at + 32),
  modelForce: memory.triple(at + 56),
  force: memory.triple(at + 80),
  forceScale: view.getFloat64(at + 104, true),
  ceiling: view.getFloat64(at + 112, true),
  thumbForce: view.getFloat64(at + 120, true),
  plunger: view.getFloat64(at + 128, true),
  plungerForce: view.getFloat64(at + 136, true),
  pressure: view.getFloat64(at + 144, true),
  left: view.getFloat64(at + 152, true),
});
