// The columns that a run fills for each membrane.
#pragma once

#include <cstdint>

#include "bindings.hpp"

namespace punctura::bindings {

/// Filled without the GIL, then handed to NumPy.
class MembraneColumns {
 public:
  MembraneColumns(std::size_t ticks, std::size_t membranes)
      : n_(ticks), m_(membranes), depth_(n_ * m_), force_(n_ * m_), lower_(n_ * m_), upper_(n_ * m_), phase_(n_ * m_) {}

  void set(std::size_t tick, std::size_t membrane, double depth, double force, double lower, double upper,
           Phase phase) noexcept {
    const std::size_t at = tick * m_ + membrane;
    depth_[at] = depth;
    force_[at] = force;
    lower_[at] = lower;
    upper_[at] = upper;
    phase_[at] = static_cast<std::uint8_t>(phase);
  }

 private:
  friend struct MembraneArrays;
  std::size_t n_, m_;
  std::vector<double> depth_, force_, lower_, upper_;
  std::vector<std::uint8_t> phase_;
};

/// The same as NumPy arrays, each (n, m).
struct MembraneArrays {
  explicit MembraneArrays(MembraneColumns&& c)
      : depth(to_numpy(std::move(c.depth_), {c.n_, c.m_})),
        axial_force(to_numpy(std::move(c.force_), {c.n_, c.m_})),
        lower(to_numpy(std::move(c.lower_), {c.n_, c.m_})),
        upper(to_numpy(std::move(c.upper_), {c.n_, c.m_})),
        phase(to_numpy(std::move(c.phase_), {c.n_, c.m_})) {}
  nb::object depth, axial_force, lower, upper, phase;
};

struct InsertionTrace : MembraneArrays {
  InsertionTrace(nb::object total, MembraneColumns&& columns)
      : MembraneArrays(std::move(columns)), force(std::move(total)) {}
  nb::object force;
};

template <typename Trace>
void def_membrane_columns(nb::class_<Trace>& trace) {
  trace
      .def_prop_ro(
          "depth", [](const Trace& t) { return t.depth; },
          nb::sig("def depth(self) -> numpy.typing.NDArray[numpy.float64]"),
          "Of each membrane, (n, m), m. Inside: along the needle, where the band was taken; else along the normal")
      .def_prop_ro(
          "axial_force", [](const Trace& t) { return t.axial_force; },
          nb::sig("def axial_force(self) -> numpy.typing.NDArray[numpy.float64]"),
          "Of each membrane, along b, (n, m), N")
      .def_prop_ro(
          "lower", [](const Trace& t) { return t.lower; },
          nb::sig("def lower(self) -> numpy.typing.NDArray[numpy.float64]"), "Lower edge of the band, (n, m), N")
      .def_prop_ro(
          "upper", [](const Trace& t) { return t.upper; },
          nb::sig("def upper(self) -> numpy.typing.NDArray[numpy.float64]"), "Upper edge of the band, (n, m), N")
      .def_prop_ro(
          "phase", [](const Trace& t) { return t.phase; },
          nb::sig("def phase(self) -> numpy.typing.NDArray[numpy.uint8]"),
          "Phase of each membrane as its number, (n, m)");
}

}  // namespace punctura::bindings
