#include "controller.hpp"

#include <chrono>
#include <limits>
#include <thread>

namespace punctura::fake_drd {

namespace {

constexpr int somebody_has_it = 20, communication = 2, no_device = 5, timeout = 7, not_ready = 12, invalid = 21;
constexpr std::int64_t first_moment = 1'000'000'000;

std::int64_t steady_ns() {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(std::chrono::steady_clock::now().time_since_epoch())
      .count();
}

}  // namespace

thread_local int Controller::error = 0;

Controller& controller() {
  static auto& all = *new Controller;
  return all;
}

void Controller::reset(const Settings& wanted) {
  settings = wanted;
  buttons = 0;
  is_open = safety_touched = false;
  calibrations = 0;
  virtual_ = false;
  real_offset_ = steady_ns() - first_moment;
  time_ = plant_time_ = motion_start_ = last_write_ = first_moment;
  last_force_ = inject_at_ = happened_ = 0;
  injected_ = once_ = -1;
  plugged_ = true;
  force_on_ = braking_ = fault_ = nan_ = leap_ = frozen_ = false;
  reset_mode_ = settings.calibrated == 0;
  cause_ = settings.old_force_off_cause;
  reads_ = writes_ = 0;
  sent_ = given_ = reading_ = Vector3d::Zero();
  dynamics_ = {0.045, settings.friction, settings.encoder_step, settings.motor_force};
  Hand hand;
  hand.tremor_rms = settings.tremor;
  plant_.emplace(dynamics_, hand, static_cast<double>(step_ns) * 1e-9, 1);
  move_to(Vector3d(0, 0, 5e-3));
}

void Controller::move_to(const Vector3d& position) {
  if (auto* target = std::get_if<Target>(&motion_); target && is_open) {
    target->move_to(position);
    return;
  }
  motion_ = Target(position);
  motion_start_ = plant_time_;
  plant_->place(position);
}

void Controller::begin(const Strokes& s) {
  motion_ = StrokesMotion(
      {Vector3d(s.start), Vector3d(s.end), static_cast<std::size_t>(s.count), s.duration, s.rest, s.variation}, s.seed);
  motion_start_ = plant_time_;
  plant_->place(Vector3d(s.start));
}

void Controller::use_virtual_time(bool on) { virtual_ = on; }

std::int64_t Controller::now() {
  catch_up();
  return time_;
}

/// In real time, moves the plant by the time since the last call.
void Controller::catch_up() {
  if (!virtual_) advance(steady_ns() - real_offset_);
}

void Controller::wait(double seconds) {
  if (seconds <= 0) return;
  if (!virtual_) std::this_thread::sleep_for(std::chrono::duration<double>(seconds));
  virtual_ ? advance(time_ + static_cast<std::int64_t>(seconds * 1e9)) : catch_up();
}

void Controller::advance(std::int64_t to) {
  while (plant_time_ + step_ns <= to) {
    step();
    plant_time_ += step_ns;
  }
  time_ = std::max(time_, to);
  if (injected_ >= 0 && time_ >= inject_at_) happen();
}

/// 0.125 ms of the device: first its safety, then its motors.
void Controller::step() {
  if (injected_ >= 0 && plant_time_ >= inject_at_) happen();
  if (force_on_ && static_cast<double>(plant_time_ - last_write_) * 1e-9 > settings.watchdog) force_off(3);
  if (force_on_ && plant_->velocity().norm() > settings.brake_speed) {
    force_off(2);
    happened_ = plant_time_;
  }
  given_ = force_on_ && plugged_ ? dynamics_.saturate(sent_) : Vector3d(Vector3d::Zero());
  if (given_ != Vector3d::Zero()) last_force_ = plant_time_ + step_ns;
  const double time = static_cast<double>(plant_time_ - motion_start_) * 1e-9;
  plant_->step(given_, std::visit([time](auto& motion) { return motion.at(time); }, motion_));
}

void Controller::force_off(int cause) {
  force_on_ = false;
  braking_ = true;
  cause_ = cause;
  given_ = Vector3d::Zero();
}

void Controller::happen() {
  const int what = injected_;
  injected_ = -1;
  happened_ = inject_at_;
  switch (what) {
    case unplug:
      plugged_ = false;
      force_off(5);
      break;
    case press_button: force_off(1); break;
    case let_go: force_off(6); break;
    case switched_off: force_off(4); break;
    case lose_zero:
      reset_mode_ = true;
      force_off(4);
      break;
    case fault_inside:
      fault_ = true;
      force_off(0);
      break;
    case nan_position: nan_ = true; break;
    case leap: leap_ = true; break;
    case freeze: frozen_ = true; break;
    default: once_ = what;
  }
}

/// Whether this call must fail once and has not failed yet.
bool Controller::once(int what) {
  if (once_ != what) return false;
  once_ = -1;
  return true;
}

bool Controller::wrong(int device) {
  if (is_open && (device == -1 || device == id)) return false;
  error = invalid;
  return true;
}

int Controller::open(int index) {
  catch_up();
  if (!plugged_) return fail(no_device);
  if (index < 0 || index >= settings.devices) return fail(no_device);
  if (settings.in_use || index > 0) return fail(somebody_has_it);
  is_open = true;
  return id;
}

int Controller::close(int device) {
  if (wrong(device)) return -1;
  is_open = false;
  if (force_on_) force_off(4);
  return 0;
}

int Controller::read(double (&position)[3]) {
  catch_up();
  wait(settings.transfer);
  if (!plugged_) return fail(communication);
  if (once(failing_read)) return fail(timeout);
  ++reads_;
  const auto every = static_cast<std::uint64_t>(settings.repeat_every);
  const bool repeated = frozen_ || (every > 0 && reads_ % every == 0);
  if (!repeated) reading_ = plant_->measured();
  for (std::size_t i = 0; i < 3; ++i) {
    position[i] = reading_[i] + (leap_ && i == 2 ? 0.25 : 0);
    if (nan_) position[i] = std::numeric_limits<double>::quiet_NaN();
  }
  return repeated ? 1 : 0;
}

int Controller::write(const double (&force)[3]) {
  catch_up();
  if (!plugged_) return fail(communication);
  if (once(failing_write)) return fail(timeout);
  ++writes_;
  writer_ = std::this_thread::get_id();
  last_write_ = time_;
  sent_ = Vector3d(force);
  return sent_.norm() > settings.motor_force ? 2 : 0;
}

int Controller::enable_force(bool on) {
  catch_up();
  if (!plugged_) return fail(communication);
  if (!on) {
    if (force_on_) force_off(4);
    return 0;
  }
  if (reset_mode_) return fail(not_ready);
  switcher_ = std::this_thread::get_id();
  if (settings.starts_forces) {
    force_on_ = true;
    braking_ = false;
    last_write_ = time_;
  }
  return 0;
}

int Controller::status(int* array) {
  catch_up();
  if (!plugged_ || once(failing_status)) return fail(communication);
  const int all[17] = {1,
                       1,
                       1,
                       reset_mode_,
                       !reset_mode_ && !force_on_ && !braking_,
                       force_on_,
                       braking_,
                       1,
                       settings.wrist,
                       fault_,
                       1,
                       settings.repeat_every > 0,
                       settings.wrist,
                       0,
                       cause_,
                       -1,
                       7};
  for (int i = 0; i < 17; ++i) array[i] = all[i];
  return 0;
}

int Controller::calibrate() {
  catch_up();
  if (!plugged_) return fail(communication);
  ++calibrations;
  reset_mode_ = false;
  return 0;
}

Report Controller::report() {
  catch_up();
  Report r{};
  r.now = time_;
  r.last_force = last_force_;
  r.injected = happened_;
  for (std::size_t i = 0; i < 3; ++i) {
    r.force[i] = given_[i];
    r.sent[i] = sent_[i];
    r.position[i] = plant_->tip()[i];
  }
  r.reads = reads_;
  r.writes = writes_;
  r.force_on = force_on_;
  r.open = is_open;
  r.calibrations = calibrations;
  r.switched_on_by_writer = switcher_ == writer_;
  r.touched_safety = safety_touched;
  return r;
}

}  // namespace punctura::fake_drd
