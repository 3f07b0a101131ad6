// The functions with which tests control the fake and read its records.
#include <algorithm>

#include "fake_hd.hpp"

namespace fake_hd {

Fake& Fake::one() {
  static auto* fake = new Fake;  // its thread may end after all other objects
  return *fake;
}

Fake::Fake() {
  fake_hd_settings defaults;
  fake_hd_defaults(&defaults);
  reset(defaults);
}

void Fake::reset(const fake_hd_settings& wanted_settings) {
  stop();
  {
    const std::lock_guard lock(calling);
    operations.clear();
  }
  const std::lock_guard lock(state);
  settings = wanted_settings;
  name = settings.name ? settings.name : "";
  open = force_output = frozen = unplugged = in_frame = framed = false;
  one_frame = true;
  current = 0xFFFFFFFF;
  rate = settings.only_rate != 0 ? settings.only_rate : 1000;
  errors.clear();
  faults.clear();
  records.clear();
  misuses = 0;
  reading = last = {};
  wanted = held = {};
  tick = spent = 0;
  records.reserve(65536);
  lay_out();
}

void Fake::restart() {
  const std::lock_guard lock(state);
  tick = 0;
  records.clear();
  faults.clear();
  lay_out();
}

}  // namespace fake_hd

using fake_hd::Fake;

EXPORT void fake_hd_defaults(fake_hd_settings* to) {
  *to = {};
  to->name = "Default Device";
  to->null_opens = 1;
  to->rate_error = 0x101;
  to->from_mm[1] = 5;
  to->to_mm[1] = -10;
  to->duration = 1;
  to->axis[1] = -1;
  to->stretch = 1;
  to->calibration = 0x5000;
  to->style = 4;
  to->renewing_works = 1;
}

EXPORT void fake_hd_reset(const fake_hd_settings* settings) {
  fake_hd_settings defaults;
  fake_hd_defaults(&defaults);
  Fake::one().reset(settings ? *settings : defaults);
}

EXPORT void fake_hd_restart() { Fake::one().restart(); }

EXPORT void fake_hd_inject(int fault, unsigned value, unsigned long long first, unsigned long long ticks) {
  const std::lock_guard lock(Fake::one().state);
  Fake::one().faults.push_back({fault, value, first, ticks});
}

EXPORT unsigned long long fake_hd_ticks() { return Fake::one().tick; }
EXPORT long long fake_hd_now_ns() { return Fake::one().now; }

EXPORT unsigned long long fake_hd_records(fake_hd_record* to, unsigned long long most) {
  Fake& f = Fake::one();
  const std::lock_guard lock(f.state);
  const auto count = std::min<unsigned long long>(most, f.records.size());
  std::copy_n(f.records.begin(), count, to);
  return count;
}

EXPORT void fake_hd_held_force(double force[3]) {
  Fake& f = Fake::one();
  const std::lock_guard lock(f.state);
  std::copy(f.held.begin(), f.held.end(), force);
}

EXPORT int fake_hd_scheduler_runs() {
  const std::lock_guard lock(Fake::one().state);
  return Fake::one().runs;
}

EXPORT int fake_hd_operations() {
  const std::lock_guard lock(Fake::one().calling);
  return static_cast<int>(Fake::one().operations.size());
}

EXPORT int fake_hd_devices_open() {
  const std::lock_guard lock(Fake::one().state);
  return Fake::one().open;
}

EXPORT unsigned long long fake_hd_misuses() {
  const std::lock_guard lock(Fake::one().state);
  return Fake::one().misuses;
}
