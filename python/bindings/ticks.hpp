// Many ticks in one call, without the GIL, with progress, and interruptible by Ctrl-C; and checks of the inputs.
#pragma once

#include <algorithm>
#include <chrono>
#include <cmath>
#include <string>

#include "bindings.hpp"
#include "punctura/model/decimal.hpp"
#include "without_lock.hpp"

namespace punctura::bindings {

/// The argument `progress` of a run: None, a function of the finished share (0 to 1), or True for a bar.
class Progress {
 public:
  explicit Progress(const nb::object& given) {
    if (given.is_none()) return;
    context_ = nb::module_::import_("punctura.progress").attr("reporting")(given);
    report_ = context_.attr("__enter__")();
  }
  Progress(const Progress&) = delete;
  ~Progress() {
    try {
      if (report_) context_.attr("__exit__")(nb::none(), nb::none(), nb::none());
    } catch (nb::python_error& error) {
      error.discard_as_unraisable("progress");
    }
  }
  void report(std::size_t done, std::size_t all) const {
    if (report_) report_(static_cast<double>(done) / static_cast<double>(all));
  }

 private:
  nb::object context_, report_;
};

/// Calls tick(i) for i = 0 ... n-1. Every 50 ms it tells the progress, and Ctrl-C can act: the object has then made
/// some of the ticks, and their columns are lost.
template <typename Tick>
void make_ticks(std::size_t n, Tick&& tick, const nb::object& given = nb::none()) {
  constexpr std::size_t chunk = 64;
  const Progress progress(given);
  for (std::size_t i = 0; i < n;) {
    {
      const WithoutLock release;
      const auto until = std::chrono::steady_clock::now() + std::chrono::milliseconds(50);
      do {
        for (const std::size_t end = std::min(n, i + chunk); i < end; ++i) tick(i);
      } while (i < n && std::chrono::steady_clock::now() < until);
    }
    if (PyErr_CheckSignals() != 0) throw nb::python_error();
    progress.report(i, n);
  }
}

/// Throws ValueError for the first bad number; the message has the argument, its index, the number and the remedy.
template <typename Good>
void check_numbers(const double* values, std::size_t n, const char* name, std::size_t row_length, Good&& good,
                   const char* says, const char* remedy) {
  const double* bad = std::find_if_not(values, values + n, good);
  if (bad == values + n) return;
  const std::size_t at = static_cast<std::size_t>(bad - values);
  const std::string place = row_length > 0 ? "[" + std::to_string(at / row_length) + "]" : "";
  throw value_error(std::string(name) + place + says + decimal_text(*bad, 6) + remedy + ". No tick was made");
}

/// Requires finite numbers. row_length: numbers per row of an array; 0 for a single value.
inline void check_finite(const double* values, std::size_t n, const char* name, std::size_t row_length = 0) {
  check_numbers(
      values, n, name, row_length, [](double x) { return std::isfinite(x); }, " must be finite and holds ",
      ": leave such ticks out, or fill them in");
}

/// Requires finite positions within 1000 km.
inline void check_places(const double* values, std::size_t n, const char* name, std::size_t row_length = 0) {
  check_finite(values, n, name, row_length);
  check_numbers(
      values, n, name, row_length, [](double x) { return is_place(x); }, " holds ",
      " m: positions must be within 1000 km");
}

/// A position as a vector. Throws ValueError if a number is not finite or beyond 1000 km.
inline Vector3d place(const Triple& position) {
  if (!std::all_of(position.begin(), position.end(), [](double x) { return is_place(x); }))
    throw value_error("position must be three finite numbers, m, within 1000 km, not " +
                      nb::cast<std::string>(nb::repr(nb::make_tuple(position[0], position[1], position[2]))));
  return to_vector(position);
}

/// Throws ValueError for a direction of length 0.
inline void check_direction(const Vector3d& axis, const std::string& name) {
  if (axis == Vector3d()) throw value_error(name + " must be a direction: at least one of its three numbers not 0");
}

/// The needle's direction as a unit vector. Throws ValueError for length 0.
inline Vector3d direction(const Triple& axis) {
  check_finite(axis.data(), 3, "axis");
  check_direction(to_vector(axis), "axis");
  return to_vector(axis).stableNormalized();
}

}  // namespace punctura::bindings
