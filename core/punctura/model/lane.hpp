// The few functions with which one text of the model serves a single number and a vector of lanes.
#pragma once

#include <algorithm>
#include <cmath>
#include <concepts>
#include <type_traits>
#include <utility>

namespace punctura {

template <typename V>
concept OneNumber = std::floating_point<V>;

/// Several numbers that are computed together, one per lane: a SIMD type. It needs
///
/// - `value_type`, float or double; implicit construction from it; + - * / and the unary minus, lane by lane;
/// - comparisons and their masks: a mask has `&&`, `||`, `!` and is constructed from a bool. It must not convert to bool: an `if`
///   that reads one lane would decide for all;
/// - `select(mask, a, b)`, `any(mask)`, `all(mask)`, `min`, `max`, `sqrt`, and to construct laws `tan` and `cos`: found by
///   argument-dependent lookup. min(a, b) is b < a ? b : a, and max(a, b) is a < b ? b : a.
///
/// All of them noexcept and without memory. Then each lane gives the bits of a run with a single number.
template <typename V>
concept Lanes = !OneNumber<V> && OneNumber<typename V::value_type>;

/// The type of one lane.
template <typename V>
struct LaneOf {
  using type = typename V::value_type;
};
template <OneNumber V>
struct LaneOf<V> {
  using type = V;
};
template <typename V>
using Lane = typename LaneOf<V>::type;

/// What a comparison gives: bool, or one for each lane.
template <typename V>
using Mask = std::remove_cvref_t<decltype(std::declval<const V&>() < std::declval<const V&>())>;

/// For one number. The model's functions say `using namespace lane` and call these without a namespace, so that a vector brings its own.
namespace lane {

template <typename T>
constexpr T select(bool mask, const T& a, const T& b) noexcept {
  return mask ? a : b;
}
constexpr bool any(bool mask) noexcept { return mask; }
constexpr bool all(bool mask) noexcept { return mask; }

using std::max;
using std::min;
template <OneNumber T>
T sqrt(T x) noexcept {
  return std::sqrt(x);
}
template <OneNumber T>
T tan(T x) noexcept {
  return std::tan(x);
}
template <OneNumber T>
T cos(T x) noexcept {
  return std::cos(x);
}

}  // namespace lane
}  // namespace punctura
