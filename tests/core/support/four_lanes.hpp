// A simple SIMD type for tests: four numbers in an array. Its mask does not convert to bool.
#pragma once

#include <array>
#include <cmath>
#include <concepts>

namespace punctura::test {

struct FourBools {
  std::array<bool, 4> lane{};

  FourBools() = default;
  explicit FourBools(bool all) noexcept { lane.fill(all); }

  template <typename Op>
  static FourBools each(Op op) noexcept {
    FourBools result;
    for (std::size_t i = 0; i < 4; ++i) result.lane[i] = op(i);
    return result;
  }
  friend FourBools operator&&(const FourBools& a, const FourBools& b) noexcept {
    return each([&](std::size_t i) { return a.lane[i] && b.lane[i]; });
  }
  friend FourBools operator||(const FourBools& a, const FourBools& b) noexcept {
    return each([&](std::size_t i) { return a.lane[i] || b.lane[i]; });
  }
  friend FourBools operator!(const FourBools& a) noexcept {
    return each([&](std::size_t i) { return !a.lane[i]; });
  }
};
inline bool any(const FourBools& m) noexcept { return m.lane[0] || m.lane[1] || m.lane[2] || m.lane[3]; }
inline bool all(const FourBools& m) noexcept { return m.lane[0] && m.lane[1] && m.lane[2] && m.lane[3]; }

template <std::floating_point Scalar>
struct FourLanes {
  using value_type = Scalar;
  std::array<Scalar, 4> lane{};

  FourLanes() = default;
  FourLanes(Scalar all) noexcept { lane.fill(all); }

  template <typename Op>
  static FourLanes each(Op op) noexcept {
    FourLanes result;
    for (std::size_t i = 0; i < 4; ++i) result.lane[i] = op(i);
    return result;
  }
  using V = FourLanes;
  friend V operator+(const V& a, const V& b) noexcept {
    return each([&](std::size_t i) { return a.lane[i] + b.lane[i]; });
  }
  friend V operator-(const V& a, const V& b) noexcept {
    return each([&](std::size_t i) { return a.lane[i] - b.lane[i]; });
  }
  friend V operator*(const V& a, const V& b) noexcept {
    return each([&](std::size_t i) { return a.lane[i] * b.lane[i]; });
  }
  friend V operator/(const V& a, const V& b) noexcept {
    return each([&](std::size_t i) { return a.lane[i] / b.lane[i]; });
  }
  friend V operator-(const V& a) noexcept {
    return each([&](std::size_t i) { return -a.lane[i]; });
  }
  friend FourBools operator<(const V& a, const V& b) noexcept {
    return FourBools::each([&](std::size_t i) { return a.lane[i] < b.lane[i]; });
  }
  friend FourBools operator<=(const V& a, const V& b) noexcept {
    return FourBools::each([&](std::size_t i) { return a.lane[i] <= b.lane[i]; });
  }
  friend FourBools operator==(const V& a, const V& b) noexcept {
    return FourBools::each([&](std::size_t i) { return a.lane[i] == b.lane[i]; });
  }
  friend FourBools operator>(const V& a, const V& b) noexcept { return b < a; }
  friend FourBools operator>=(const V& a, const V& b) noexcept { return b <= a; }

  friend V select(const FourBools& mask, const V& a, const V& b) noexcept {
    return each([&](std::size_t i) { return mask.lane[i] ? a.lane[i] : b.lane[i]; });
  }
  friend V min(const V& a, const V& b) noexcept { return select(b < a, b, a); }
  friend V max(const V& a, const V& b) noexcept { return select(a < b, b, a); }
  friend V sqrt(const V& a) noexcept {
    return each([&](std::size_t i) { return std::sqrt(a.lane[i]); });
  }
  friend V tan(const V& a) noexcept {
    return each([&](std::size_t i) { return std::tan(a.lane[i]); });
  }
  friend V cos(const V& a) noexcept {
    return each([&](std::size_t i) { return std::cos(a.lane[i]); });
  }
};

}  // namespace punctura::test
