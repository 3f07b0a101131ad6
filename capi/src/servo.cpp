// The servo step of the C ABI.
#include "common.hpp"
#include "stepper.hpp"

using namespace punctura::c;
using punctura::DeviceSample;
using punctura::ForceLimits;
using punctura::GateLimits;
using punctura::Snapshot;

PUNCTURA_STEPPER(servo, punctura::ServoStep)
PUNCTURA_CALL(servo, arm)
PUNCTURA_CALL(servo, disarm)

namespace {

punctura_limits default_limits() noexcept {
  const GateLimits gate;
  const ForceLimits force;
  return {sizeof(punctura_limits), force.max_force,     force.continuous_force, force.continuous_time,
          force.ramp_time,         force.warm_motor,    gate.max_speed,         gate.stale,
          gate.deadline,           gate.axis_tolerance, gate.dead_man};
}

punctura_sample default_sample() noexcept { return {sizeof(punctura_sample), 0, 0, {0, 0, 0}, {0, -1, 0}, 0, 1, 0, 0}; }

DeviceSample sample_of(const punctura_sample& given) noexcept {
  const punctura_sample s = taken(&given, default_sample());
  const auto &p = s.position, &b = s.axis;
  return {s.sequence, s.time,         {p[0], p[1], p[2]},  {b[0], b[1], b[2]},
          s.buttons,  s.healthy != 0, s.motor_temperature, s.thumb};
}

void give_record(const Snapshot& t, double thumb_force, punctura_record* record) noexcept {
  const auto &tip = t.tip, &m = t.model_force, &f = t.force;
  give(record, {sizeof *record,
                t.tick,
                static_cast<int32_t>(t.state),
                static_cast<int32_t>(t.fault),
                static_cast<int32_t>(t.limit),
                t.membrane_count,
                {tip[0], tip[1], tip[2]},
                {m[0], m[1], m[2]},
                {f[0], f[1], f[2]},
                t.force_scale,
                t.ceiling,
                thumb_force,
                t.syringe.plunger,
                t.syringe.force,
                t.syringe.pressure,
                t.syringe.left});
}

punctura_status tick(punctura::ServoStep& servo, const punctura_sample& sample, punctura_record* record) noexcept {
  const Snapshot& snapshot = servo.step(sample_of(sample));
  give_record(snapshot, static_cast<double>(servo.thumb_force()), record);
  return ok;
}

/// No tick: the record of the last one must not keep a force. The fields of version 1 are there whatever struct_size
/// says, because no header has a shorter record.
punctura_status no_tick(punctura_record* record) noexcept {
  if (record) {
    for (double& f : record->force) f = 0;
    for (double& f : record->model_force) f = 0;
    record->thumb_force = 0;
  }
  return PUNCTURA_BAD_ARGUMENT;
}

}  // namespace

punctura_status punctura_limits_init(punctura_limits* limits, size_t size) {
  return init(limits, size, default_limits());
}

punctura_status punctura_sample_init(punctura_sample* sample, size_t size) {
  return init(sample, size, default_sample());
}

punctura_status punctura_servo_new(const punctura_scene* scene, const punctura_limits* limits, punctura_servo** servo) {
  return make_handle(scene, servo, [&](auto& made) {
    if (limits && !known_size(limits))
      return fail(PUNCTURA_BAD_ARGUMENT, "limits.struct_size is wrong: call punctura_limits_init()");
    const punctura_limits l = limits ? taken(limits, default_limits()) : default_limits();
    const GateLimits gate{l.max_speed, l.stale, l.deadline, l.axis_tolerance, l.dead_man};
    const ForceLimits force{l.max_force, l.continuous_force, l.continuous_time, l.ramp_time, l.warm_motor};
    std::vector<punctura::Problem> problems;
    auto built = punctura::try_build(scene->scene, problems, gate, force);
    if (!built) return fail(std::move(problems));
    made = std::make_unique<punctura_servo>(std::move(*built));
    return ok;
  });
}

punctura_status punctura_servo_step(punctura_servo* servo, const punctura_sample* sample, punctura_record* record) {
  if (!servo || !known_size(sample) || !known_size(record)) return no_tick(record);
  return tick(servo->stepping(), *sample, record);
}

punctura_status punctura_servo_peek(punctura_servo* servo, const punctura_sample* sample, punctura_record* record) {
  if (!servo || !known_size(sample) || !known_size(record)) return no_tick(record);
  return tick(servo->peeking(), *sample, record);
}

punctura_status punctura_servo_membrane(const punctura_servo* servo, int32_t membrane, punctura_membrane_tick* tick) {
  if (!servo || membrane < 0) return PUNCTURA_BAD_ARGUMENT;
  const Snapshot& snapshot = servo->now.snapshot();
  if (static_cast<uint32_t>(membrane) >= snapshot.membrane_count) return PUNCTURA_BAD_ARGUMENT;
  return give_membrane(tick, snapshot.membranes[static_cast<size_t>(membrane)]);
}
