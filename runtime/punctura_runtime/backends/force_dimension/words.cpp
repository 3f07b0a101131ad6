// Messages of a Force Dimension device: its trouble and its statements.
#include <cmath>

#include "punctura/model/decimal.hpp"
#include "punctura_runtime/backends/force_dimension/device.hpp"

namespace punctura::force_dimension {

namespace {

std::string force_off(int cause) {
  switch (static_cast<ForceOffCause>(cause)) {
    case ForceOffCause::button: return "its force button was pressed";
    case ForceOffCause::velocity: return "it moved faster than its own limit, and braked";
    case ForceOffCause::watchdog: return "its watchdog got no command in time";
    case ForceOffCause::software: return "a program switched its force off";
    case ForceOffCause::unplugged: return "its USB cable was unplugged";
    case ForceOffCause::dead_man: return "nobody held its handle (dead-man switch)";
    case ForceOffCause::none: break;
  }
  return "it does not say why";
}

std::string rounded(double value) { return decimal_text(std::round(value)); }

}  // namespace

std::string ForceDimensionDevice::trouble() const {
  const Trouble what = trouble_.load(std::memory_order_acquire);
  const int code = code_.load(std::memory_order_relaxed);
  const std::string again = " Force stays off until you stop and start again.";
  switch (what) {
    case Trouble::none: return {};
    case Trouble::reading: return info_.model + " cannot be read: " + words_for(library_.api, code) + "." + again;
    case Trouble::writing: return info_.model + " takes no force: " + words_for(library_.api, code) + "." + again;
    case Trouble::force_off: return info_.model + " has switched its force off: " + force_off(code) + "." + again;
    case Trouble::force_never_on:
      return info_.model + " has not switched its force on: press its force button, or switch it off and on." + again;
    case Trouble::calibration_lost: return calibration_advice(info_.model) + again;
    case Trouble::controller: return info_.model + " reports a fault of its controller: switch it off and on." + again;
  }
  return {};
}

std::vector<std::string> ForceDimensionDevice::statements() const {
  std::vector<std::string> all{"tested against simulated libraries only: please report how it does on your device"};
  int major = 0, minor = 0, release = 0, revision = 0;
  library_.api.version(&major, &minor, &release, &revision);
  all.push_back("library " + library_.path + ", version " + std::to_string(major) + "." + std::to_string(minor) + "." +
                std::to_string(release) + "." + std::to_string(revision));
  if (info_.rate < options_.rate)
    all.push_back("rate " + rounded(info_.rate) + " Hz, the most " +
                  (info_.rate < fastest ? "at which it can be read" : "its USB connection carries") + ", instead of " +
                  rounded(options_.rate) + " Hz");
  if (!info_.has_orientation)
    all.push_back("no wrist: set direction = \"motion\" in the scene, or the needle points away from you");
  if (const auto count = saturated(); count > 0)
    all.push_back("the motors could not give the whole force in " + std::to_string(count) + " ticks");
  if (const auto count = missed(); count > 0) all.push_back(std::to_string(count) + " ticks were skipped");
  return with_priorities(std::move(all));
}

}  // namespace punctura::force_dimension
