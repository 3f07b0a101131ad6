// Made by tools/make_tick_table.py, from core's table of a tick's fields.

/** In the order of a file's columns. column: {a} is x, y or z, {i} the membrane's number. words: by number. */
export const FIELDS = [
  { name: "time", column: "time_s", width: 1, perMembrane: false, words: null },
  { name: "position", column: "{a}_m", width: 3, perMembrane: false, words: null },
  { name: "axis", column: "axis_{a}", width: 3, perMembrane: false, words: null },
  { name: "force", column: "f{a}_N", width: 3, perMembrane: false, words: null },
  { name: "depth", column: "depth_{i}_m", width: 1, perMembrane: true, words: null },
  { name: "axial_force", column: "force_{i}_N", width: 1, perMembrane: true, words: null },
  { name: "lower", column: "lower_{i}_N", width: 1, perMembrane: true, words: null },
  { name: "upper", column: "upper_{i}_N", width: 1, perMembrane: true, words: null },
  { name: "phase", column: "phase_{i}", width: 1, perMembrane: true, words: ["outside", "sticking", "sliding_in", "sliding_out", "barred"] },
  { name: "proxy", column: "proxy_{i}_{a}_m", width: 3, perMembrane: true, words: null },
  { name: "direction", column: "direction_{i}_{a}", width: 3, perMembrane: true, words: null },
  { name: "model_force", column: "model_f{a}_N", width: 3, perMembrane: false, words: null },
  { name: "force_scale", column: "force_scale", width: 1, perMembrane: false, words: null },
  { name: "tip", column: "tip_{a}_m", width: 3, perMembrane: false, words: null },
  { name: "thumb", column: "thumb_m", width: 1, perMembrane: false, words: null },
  { name: "plunger", column: "plunger_m", width: 1, perMembrane: false, words: null },
  { name: "thumb_force", column: "thumb_force_N", width: 1, perMembrane: false, words: null },
  { name: "thumb_felt", column: "thumb_felt_N", width: 1, perMembrane: false, words: null },
  { name: "pressure", column: "pressure_Pa", width: 1, perMembrane: false, words: null },
  { name: "injected", column: "injected_m3", width: 1, perMembrane: false, words: null },
  { name: "state", column: "state", width: 1, perMembrane: false, words: ["disarmed", "waiting", "active", "faulted"] },
  { name: "fault", column: "fault", width: 1, perMembrane: false, words: ["none", "non_finite_input", "bad_axis", "position_jump", "stale_sample", "missed_deadline", "clock", "non_finite_force", "device", "thumb"] },
  { name: "limit", column: "limit", width: 1, perMembrane: false, words: ["none", "ramp", "peak", "continuous", "temperature"] },
  { name: "ceiling", column: "ceiling_N", width: 1, perMembrane: false, words: null },
] as const;
