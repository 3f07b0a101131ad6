// While a run goes on: the slope of the membrane in contact, the friction behind it, and punctures, tick by tick.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string_view>

#include "punctura/lab/trace/live_puncture.hpp"
#include "punctura/model/field.hpp"
#include "punctura/state/archive.hpp"

namespace punctura {

/// Where the needle is, as the force shows it.
enum class LivePhase : std::uint8_t {
  free,    ///< no force yet
  rise,    ///< a membrane in contact: the force grows
  behind,  ///< behind a puncture, before the next membrane
};

template <>
inline constexpr std::array<std::string_view, 3> words_of<LivePhase>{"free", "rise", "behind"};

/// The settings of a live estimate, see live_fields.
struct LiveSettings : LivePunctureSettings {
  double contact = 0.03, step = 2e-5, rise_memory = 1e-3;

  void describe(auto& parameters) const {
    LivePuncture(*this).describe(parameters);
    parameters.fields(step, rise_memory, contact);
  }
};

// clang-format off
inline constexpr FieldOf<LiveSettings> live_fields[] = {
    {{"noise", "", "N", greater_than_0,
      "Smallest standard deviation of the force from tick to tick."}, &LiveSettings::noise},
    {{"least_drop", "", "N", greater_than_0, "Smallest drop of a puncture."}, &LiveSettings::least_drop},
    {{"least_share", "", "-", {0, 1, false, true},
      "Smallest drop as a share of the force before it."}, &LiveSettings::least_share},
    {{"least_speed", "", "m/s", greater_than_0, "Slower needles make no puncture."}, &LiveSettings::least_speed},
    {{"unloading", "", "N/m", at_least_0,
      "Largest stiffness of a tissue or coupling that unloads."}, &LiveSettings::unloading},
    {{"contact", "", "N", greater_than_0, "Force above which a membrane is in contact."}, &LiveSettings::contact},
    {{"step", "", "m", greater_than_0, "The ticks of this way are averaged to one sample."}, &LiveSettings::step},
    {{"rise_memory", "", "m", greater_than_0,
      "The slope is that of the last stretch of about this length."}, &LiveSettings::rise_memory},
};
// clang-format on

/// A value with its standard deviation; both NaN while there is none.
struct LiveValue {
  double value = std::numeric_limits<double>::quiet_NaN();
  double error = std::numeric_limits<double>::quiet_NaN();
};

/// What is known after a tick.
struct LiveReading {
  LivePhase phase = LivePhase::free;
  LiveValue slope;    ///< of the force while the membrane in contact resists, N/m
  LiveValue plateau;  ///< friction behind the last puncture, N
  std::uint32_t punctures = 0;
  bool punctured = false;                                            ///< a puncture was found in this tick
  double drop = 0;                                                   ///< of the last puncture so far, N
  double puncture_depth = std::numeric_limits<double>::quiet_NaN();  ///< depth of the last puncture, m
};

/// Recursive estimates from depth and force. It allocates no memory and throws nothing.
///
/// Only ticks in which the needle is deeper than before count for slope and plateau: there the force is that of sliding
/// in. A sample that is no finite number, or a depth beyond 1000 km, is left out and counted.
class LiveEstimate {
 public:
  explicit LiveEstimate(const LiveSettings& settings = {}) noexcept
      : settings_(settings),
        puncture_(settings),
        rise_(settings.rise_memory, 0.1 * settings.noise),
        behind_(plateau_memory, 0.1 * settings.noise) {}

  void reset() noexcept { *this = LiveEstimate(settings_); }

  /// One tick. depth: m, growing inwards from any origin. force: N, against the insertion. period: s, greater than 0.
  const LiveReading& step(double depth, double force, double period) noexcept {
    reading_.punctured = false;
    if (!(std::abs(depth) < 1e6 && std::isfinite(force) && period > 0 && period < 1e6)) {
      ++ignored_;
      return reading_;
    }
    if (puncture_.step(depth, force, period) && reading_.phase != LivePhase::free) {
      reading_.punctured = true;
      reading_.puncture_depth = depth;
      ++reading_.punctures;
      reading_.phase = LivePhase::behind;
      reading_.plateau = {};
      start(behind_, depth);
    }
    reading_.drop = reading_.punctures > 0 ? puncture_.drop() : 0;
    if (puncture_.falling()) {
      start(behind_, depth);
      return reading_;
    }
    collect(depth, force);
    return reading_;
  }

  const LiveReading& reading() const noexcept { return reading_; }
  std::uint64_t ignored() const noexcept { return ignored_; }  ///< samples that were left out
  const LiveSettings& settings() const noexcept { return settings_; }

  static void archive(auto& self, auto& state) {
    state.fields(self.puncture_, self.rise_, self.behind_, self.surface_, self.last_, self.deepest_, self.sum_,
                 self.count_, self.ignored_, self.started_);
    auto& r = self.reading_;
    state.choice(r.phase, LivePhase::behind);
    state.fields(r.punctures, r.punctured, r.drop);
    for (auto* number : {&r.slope.value, &r.slope.error, &r.plateau.value, &r.plateau.error, &r.puncture_depth})
      archive_or_nan(*number, state);
  }
  void describe(auto& parameters) const { settings_.describe(parameters); }

 private:
  static constexpr double plateau_memory = 5e-3;  ///< m

  void start(LiveLine& line, double depth) noexcept {
    line.reset();
    rise_.reset();
    last_ = deepest_ = depth;
    sum_ = 0;
    count_ = 0;
    started_ = false;
    if (reading_.phase != LivePhase::rise) reading_.slope = {};
  }

  /// Averages the ticks of a step of the way, and adds the mean to the line.
  void collect(double depth, double force) noexcept {
    if (reading_.phase != LivePhase::free && depth < surface_) {  // out in front again
      reading_.phase = LivePhase::free;
      reading_.slope = reading_.plateau = {};
    }
    if (reading_.phase == LivePhase::free) {
      last_ = deepest_ = depth;
      if (puncture_.calm_force() < std::max(settings_.contact, 4 * puncture_.noise())) return;
      reading_.phase = LivePhase::rise;
      surface_ = depth;
      start(rise_, depth);
    }
    if (depth < deepest_) return;  // drawn back: the force is not that of sliding in
    deepest_ = depth;
    sum_ += force;
    ++count_;
    if (depth - last_ < settings_.step) return;
    const double mean = sum_ / static_cast<double>(count_), way = started_ ? depth - last_ : 0;
    last_ = depth;
    sum_ = 0;
    count_ = 0;
    started_ = true;
    if (reading_.phase == LivePhase::behind) settle(way, mean);
    if (reading_.phase == LivePhase::rise) {
      rise_.add(way, mean);
      if (rise_.ready()) reading_.slope = {rise_.slope(), rise_.slope_error()};
    }
  }

  /// Behind a puncture: the plateau, until the force leaves it upwards.
  void settle(double way, double mean) noexcept {
    const double more = 4 * puncture_.noise() + 0.5 * settings_.least_drop;
    if (behind_.ready() && mean > behind_.at(way) + more) {
      reading_.phase = LivePhase::rise;
      rise_.reset();
      return;
    }
    behind_.add(way, mean);
    if (behind_.ready()) reading_.plateau = {behind_.level(), behind_.level_error()};
  }

  LiveSettings settings_;
  LivePuncture puncture_;
  LiveLine rise_, behind_;
  LiveReading reading_{};
  double surface_ = 0;  ///< depth of the first contact, m
  double last_ = 0, deepest_ = 0, sum_ = 0;
  std::uint64_t count_ = 0, ignored_ = 0;
  bool started_ = false;
};

}  // namespace punctura
