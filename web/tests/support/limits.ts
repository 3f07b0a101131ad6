import type { LimitsPart } from "../../src/wire/messages.ts";

/** The default limits of a simulated Omni. */
export const LIMITS: LimitsPart = {
  max_force: 3.3,
  continuous_force: 0.88,
  continuous_time: 10,
  ramp_time: 0.5,
  warm_motor: 0.8,
  max_speed: 8,
  stale: 1,
  deadline: 1,
  axis_tolerance: 0.001,
  dead_man_buttons: [],
};
