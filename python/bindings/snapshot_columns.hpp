// Snapshots as columns: what recorders, plots and tests in Python get.
#pragma once

#include <limits>
#include <vector>

#include "bindings.hpp"
#include "punctura/servo/snapshot.hpp"

namespace punctura::bindings {

/// Filled without the GIL, snapshot by snapshot; then a dict of arrays, one row a tick.
class SnapshotColumns {
 public:
  void reserve(std::size_t n) { rows_.reserve(n); }
  void add(const Snapshot& s) {
    rows_.push_back({s.tick, s.sample, s.tip, s.model_force, s.force, s.ceiling, s.limits, s.state, s.fault, s.limit,
                     s.commands, membranes_.size(), s.membrane_count});
    membranes_.insert(membranes_.end(), s.membranes.begin(), s.membranes.begin() + s.membrane_count);
    most_ = std::max<std::size_t>(most_, s.membrane_count);
  }
  std::size_t size() const noexcept { return rows_.size(); }

  /// The dict. Of membranes: (n, m); a tick that had fewer has NaN, and phase 0, in the others.
  nb::dict to_dict() const {
    nb::dict d;
    column<std::uint64_t>(d, "tick", [](const Row& r) { return r.tick; });
    column<std::uint64_t>(d, "sequence", [](const Row& r) { return r.sample.sequence; });
    column<double>(d, "time", [](const Row& r) { return r.sample.time; });
    triples(d, "position", [](const Row& r) { return r.sample.position; });
    triples(d, "axis", [](const Row& r) { return r.sample.axis; });
    column<std::uint32_t>(d, "buttons", [](const Row& r) { return r.sample.buttons; });
    column<bool>(d, "healthy", [](const Row& r) { return r.sample.healthy; });
    column<double>(d, "motor_temperature", [](const Row& r) { return r.sample.motor_temperature; });
    triples(d, "tip", [](const Row& r) { return r.tip; });
    triples(d, "model_force", [](const Row& r) { return r.model_force; });
    triples(d, "force", [](const Row& r) { return r.force; });
    column<double>(d, "ceiling", [](const Row& r) { return r.ceiling; });
    column<std::uint64_t>(d, "peak_limited", [](const Row& r) { return r.limits.peak; });
    column<std::uint64_t>(d, "continuous_limited", [](const Row& r) { return r.limits.continuous; });
    column<std::uint64_t>(d, "temperature_limited", [](const Row& r) { return r.limits.temperature; });
    column<std::uint64_t>(d, "ramp_limited", [](const Row& r) { return r.limits.ramp; });
    column<std::uint8_t>(d, "state", [](const Row& r) { return static_cast<std::uint8_t>(r.state); });
    column<std::uint8_t>(d, "fault", [](const Row& r) { return static_cast<std::uint8_t>(r.fault); });
    column<std::uint8_t>(d, "limit", [](const Row& r) { return static_cast<std::uint8_t>(r.limit); });
    column<std::uint32_t>(d, "commands", [](const Row& r) { return r.commands; });
    membrane<double>(d, "depth", nan, [](const MembraneRecord& m) { return m.depth; });
    membrane<double>(d, "axial_force", nan, [](const MembraneRecord& m) { return m.axial_force; });
    membrane<double>(d, "lower", nan, [](const MembraneRecord& m) { return m.lower; });
    membrane<double>(d, "upper", nan, [](const MembraneRecord& m) { return m.upper; });
    membrane<std::uint8_t>(d, "phase", 0, [](const MembraneRecord& m) { return static_cast<std::uint8_t>(m.phase); });
    membrane_triples(d, "proxy", [](const MembraneRecord& m) { return m.proxy; });
    membrane_triples(d, "direction", [](const MembraneRecord& m) { return m.direction; });
    return d;
  }

 private:
  struct Row {
    std::uint64_t tick;
    DeviceSample sample;
    Triple tip, model_force, force;
    double ceiling;
    LimitCounters limits;
    ServoState state;
    Fault fault;
    Limit limit;
    std::uint32_t commands;
    std::size_t first_membrane;
    std::uint32_t membrane_count;
  };
  static constexpr double nan = std::numeric_limits<double>::quiet_NaN();

  template <typename T, typename Get>
  void column(nb::dict& d, const char* name, Get get) const {
    // A vector of bool has no memory of bools to hand over.
    std::vector<std::conditional_t<std::is_same_v<T, bool>, std::uint8_t, T>> all(rows_.size());
    for (std::size_t i = 0; i < rows_.size(); ++i) all[i] = get(rows_[i]);
    d[name] = to_numpy(std::move(all), {rows_.size()});
  }
  template <typename Get>
  void triples(nb::dict& d, const char* name, Get get) const {
    std::vector<double> all(3 * rows_.size());
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      const Triple v = get(rows_[i]);
      std::copy(v.begin(), v.end(), &all[3 * i]);
    }
    d[name] = to_numpy(std::move(all), {rows_.size(), 3});
  }
  template <typename T, typename Get>
  void membrane(nb::dict& d, const char* name, T none, Get get) const {
    std::vector<T> all(most_ * rows_.size(), none);
    for (std::size_t i = 0; i < rows_.size(); ++i)
      for (std::size_t j = 0; j < rows_[i].membrane_count; ++j)
        all[i * most_ + j] = get(membranes_[rows_[i].first_membrane + j]);
    d[name] = to_numpy(std::move(all), {rows_.size(), most_});
  }
  template <typename Get>
  void membrane_triples(nb::dict& d, const char* name, Get get) const {
    std::vector<double> all(3 * most_ * rows_.size(), nan);
    for (std::size_t i = 0; i < rows_.size(); ++i)
      for (std::size_t j = 0; j < rows_[i].membrane_count; ++j) {
        const Triple v = get(membranes_[rows_[i].first_membrane + j]);
        std::copy(v.begin(), v.end(), &all[3 * (i * most_ + j)]);
      }
    d[name] = to_numpy(std::move(all), {rows_.size(), most_, 3});
  }

  std::vector<Row> rows_;
  std::vector<MembraneRecord> membranes_;
  std::size_t most_ = 0;
};

}  // namespace punctura::bindings
