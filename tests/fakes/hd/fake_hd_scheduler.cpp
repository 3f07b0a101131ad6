// The scheduler's thread, and the device that it moves.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>

#include "fake_hd.hpp"

namespace fake_hd {

namespace {
using Locked = std::lock_guard<std::mutex>;

using punctura::to_array;

/// A rotation whose third column points against the axis, with the columns stretched.
std::array<double, 16> pose(const fake_hd_settings& s, const std::array<double, 3>& position) {
  using punctura::Vector3d;
  const Vector3d z = -Vector3d(s.axis[0], s.axis[1], s.axis[2]);
  const Vector3d x =
      Vector3d(std::abs(z.x()) < 0.9 ? 1 : 0, std::abs(z.x()) < 0.9 ? 0 : 1, 0).cross(z).stableNormalized();
  std::array<double, 16> m{};
  const std::array<Vector3d, 3> columns{x, z.cross(x), z};
  for (std::size_t c = 0; c < 3; ++c)
    for (std::size_t r = 0; r < 3; ++r) m[4 * c + r] = s.stretch * columns[c][r];
  std::copy(position.begin(), position.end(), m.begin() + 12);
  m[15] = 1;
  return m;
}
}  // namespace

double Fake::period() const { return 1 / (settings.real_rate > 0 ? settings.real_rate : static_cast<double>(rate)); }

void Fake::lay_out() {
  const punctura::Vector3d from(settings.from_mm), to(settings.to_mm);
  const punctura::StrokesMotion motion({from * 1e-3, to * 1e-3, 1, settings.duration, 0.6, 0}, settings.seed);
  motion_.assign(1, motion);
  plant_.assign(1, punctura::Plant({}, {}, period(), settings.seed));
  plant_[0].place(motion_[0].at(0).position);
  laid_out_for_ = period();
}

void Fake::start() {
  const Locked lock(state);
  if (runs) return;
  if (laid_out_for_ != period()) lay_out();
  runs = true;
  stopping_ = false;
  thread_ = std::thread([this] { run(); });
}

void Fake::stop() {
  stopping_ = true;
  if (thread_.get_id() == std::this_thread::get_id()) return;
  if (thread_.joinable()) thread_.join();
  const Locked lock(state);
  runs = false;
}

void Fake::run() {
  auto due = std::chrono::steady_clock::now();
  while (!stopping_) {
    double seconds;
    bool fast;
    {
      const Locked lock(state);
      seconds = period();
      fast = spent < settings.fast_ticks;
    }
    if (fast) {
      due = std::chrono::steady_clock::now();
      std::this_thread::yield();  // to threads that wait for a lock
    } else {
      due += std::chrono::nanoseconds(std::llround(seconds * 1e9));
      std::this_thread::sleep_until(due);
    }
    one_tick(seconds);
  }
}

void Fake::one_tick(double seconds) {
  punctura::Desired desired{};
  bool silent;
  {
    const Locked lock(state);
    now += std::llround(seconds * 1e9);
    framed = false;
    desired = motion_[0].at(static_cast<double>(tick) * seconds);
    sense(desired);
    silent = frozen;
  }
  if (!silent) call_operations();

  const Locked lock(state);
  plant_[0].step(punctura::Vector3d(held.data()), desired);
  if (records.size() < 65536) {
    fake_hd_record r{static_cast<double>(tick) * seconds, {}, {}};
    std::copy(reading.position.begin(), reading.position.end(), r.position);
    std::copy(held.begin(), held.end(), r.force);
    records.push_back(r);
  }
  ++tick;
  ++spent;
}

void Fake::sense(const punctura::Desired& desired) {
  if (injected(FAKE_HD_FREEZE)) frozen = true;
  if (injected(FAKE_HD_UNPLUG)) unplugged = true;
  if (unsigned value = 0; injected(FAKE_HD_CALIBRATION, &value)) settings.calibration = value;
  if (unplugged) {  // no power and no new data
    held = {};
    return;
  }
  reading.position = to_array(1e3 * (settings.ideal ? desired.position : plant_[0].measured()));
  if (unsigned mm = 0; injected(FAKE_HD_JUMP, &mm)) reading.position[1] += mm;
  if (injected(FAKE_HD_NOT_A_NUMBER)) reading.position[0] = std::numeric_limits<double>::quiet_NaN();
  reading.transform = pose(settings, reading.position);
  reading.buttons = settings.buttons;
}

void Fake::call_operations() {
  const std::lock_guard lock(calling);
  called_ = operations;  // an operation may schedule and unschedule others
  for (const Scheduled& s : called_) {
    const bool still =
        std::any_of(operations.begin(), operations.end(), [&](const Scheduled& o) { return o.handle == s.handle; });
    if (still && s.operation(s.data) == 0)
      std::erase_if(operations, [&](const Scheduled& o) { return o.handle == s.handle; });
  }
}

unsigned long Fake::schedule(Operation operation, void* data, std::uint16_t priority) {
  const std::lock_guard lock(calling);
  operations.push_back({next_, operation, data, priority});
  std::stable_sort(operations.begin(), operations.end(),
                   [](const Scheduled& a, const Scheduled& b) { return a.priority > b.priority; });
  return next_++;
}

void Fake::unschedule(unsigned long handle) {
  const std::lock_guard lock(calling);
  if (std::erase_if(operations, [&](const Scheduled& o) { return o.handle == handle; }) > 0) return;
  const Locked state_lock(state);
  push(0x104);
}

void Fake::synchronously(Operation operation, void* data) {
  const std::lock_guard lock(calling);
  operation(data);
}

/// floor(8000/N + 0.5) for some N, or the only rate that this device has.
void Fake::set_rate(unsigned long hz) {
  const Locked lock(state);
  bool has = false;
  if (settings.only_rate != 0)
    has = hz == settings.only_rate;
  else
    for (int n = 1; n <= 80 && !has; ++n) has = static_cast<double>(hz) == std::floor(8000.0 / n + 0.5);
  if (!has) return push(settings.rate_error);
  rate = hz;
}

}  // namespace fake_hd
