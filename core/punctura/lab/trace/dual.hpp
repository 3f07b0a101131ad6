// A dual number: a value and its derivatives by N parameters. The model, computed with it, gives exact derivatives.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <type_traits>

#include "punctura/model/lane.hpp"

namespace punctura {

/// A value and its derivatives by N parameters (forward automatic differentiation).
///
/// Comparisons compare the values. Where a curve has a corner, the derivatives are those of the side that the value
/// takes.
template <std::size_t N>
struct Dual {
  double value = 0;
  std::array<double, N> d{};  ///< derivatives

  Dual() = default;
  constexpr Dual(double x) noexcept : value(x) {}  // implicit: constants have no derivatives
  /// Parameter i itself: its derivative by parameter i is 1.
  static constexpr Dual parameter(double x, std::size_t i) noexcept {
    Dual a(x);
    a.d[i] = 1;
    return a;
  }

  friend constexpr Dual operator+(const Dual& a, const Dual& b) noexcept {
    return combined(a.value + b.value, 1, a, 1, b);
  }
  friend constexpr Dual operator-(const Dual& a, const Dual& b) noexcept {
    return combined(a.value - b.value, 1, a, -1, b);
  }
  friend constexpr Dual operator*(const Dual& a, const Dual& b) noexcept {
    return combined(a.value * b.value, b.value, a, a.value, b);
  }
  friend constexpr Dual operator/(const Dual& a, const Dual& b) noexcept {
    const double inverse = 1 / b.value, quotient = a.value / b.value;
    return combined(quotient, inverse, a, -quotient * inverse, b);
  }
  friend constexpr Dual operator+(const Dual& a, double b) noexcept { return scaled(a.value + b, 1, a); }
  friend constexpr Dual operator+(double a, const Dual& b) noexcept { return scaled(a + b.value, 1, b); }
  friend constexpr Dual operator-(const Dual& a, double b) noexcept { return scaled(a.value - b, 1, a); }
  friend constexpr Dual operator-(double a, const Dual& b) noexcept { return scaled(a - b.value, -1, b); }
  friend constexpr Dual operator*(const Dual& a, double b) noexcept { return scaled(a.value * b, b, a); }
  friend constexpr Dual operator*(double a, const Dual& b) noexcept { return scaled(a * b.value, a, b); }
  friend constexpr Dual operator/(const Dual& a, double b) noexcept { return scaled(a.value / b, 1 / b, a); }
  friend constexpr Dual operator-(const Dual& a) noexcept { return scaled(-a.value, -1, a); }
  friend constexpr Dual operator+(const Dual& a) noexcept { return a; }
  constexpr Dual& operator+=(const Dual& b) noexcept { return *this = *this + b; }
  constexpr Dual& operator-=(const Dual& b) noexcept { return *this = *this - b; }
  constexpr Dual& operator*=(const Dual& b) noexcept { return *this = *this * b; }
  constexpr Dual& operator/=(const Dual& b) noexcept { return *this = *this / b; }

  friend constexpr bool operator==(const Dual& a, const Dual& b) noexcept { return a.value == b.value; }
  friend constexpr auto operator<=>(const Dual& a, const Dual& b) noexcept { return a.value <=> b.value; }

  friend Dual sqrt(const Dual& a) noexcept {
    const double root = std::sqrt(a.value);
    return scaled(root, root > 0 ? 0.5 / root : 0, a);  // at 0, where a curve turns back, there is no derivative
  }
  friend Dual exp(const Dual& a) noexcept {
    const double e = std::exp(a.value);
    return scaled(e, e, a);
  }
  friend Dual expm1(const Dual& a) noexcept { return scaled(std::expm1(a.value), std::exp(a.value), a); }
  friend Dual log(const Dual& a) noexcept { return scaled(std::log(a.value), 1 / a.value, a); }
  friend Dual cos(const Dual& a) noexcept { return scaled(std::cos(a.value), -std::sin(a.value), a); }
  friend Dual tan(const Dual& a) noexcept {
    const double t = std::tan(a.value);
    return scaled(t, 1 + t * t, a);
  }
  friend Dual abs(const Dual& a) noexcept { return a.value < 0 ? -a : a; }
  friend bool isfinite(const Dual& a) noexcept { return std::isfinite(a.value); }

 private:
  static constexpr Dual scaled(double value, double by, const Dual& a) noexcept {
    Dual c(value);
    for (std::size_t i = 0; i < N; ++i) c.d[i] = by * a.d[i];
    return c;
  }
  static constexpr Dual combined(double value, double by_a, const Dual& a, double by_b, const Dual& b) noexcept {
    Dual c(value);
    for (std::size_t i = 0; i < N; ++i) c.d[i] = by_a * a.d[i] + by_b * b.d[i];
    return c;
  }
};

template <std::size_t N>
inline constexpr bool is_one_number<Dual<N>> = true;
template <std::size_t N>
struct LaneOf<Dual<N>> {
  using type = double;
};

/// Derivatives are not computed in a tick of a servo loop: they may become denormal.
template <std::size_t N>
Dual<N> without_denormals(const Dual<N>& e) noexcept {
  return e;
}

}  // namespace punctura

template <std::size_t N>
class std::numeric_limits<punctura::Dual<N>> : public std::numeric_limits<double> {};
