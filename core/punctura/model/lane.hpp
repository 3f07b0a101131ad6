// Functions that let the same code compute with one number or with a vector of lanes (SIMD).
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <concepts>
#include <cstdint>
#include <limits>
#include <type_traits>
#include <utility>

// The input gate and the last check before the device test numbers for NaN. -ffast-math removes these tests silently.
#if defined(__FAST_MATH__) || (defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__) || defined(_M_FP_FAST)
#error \
    "Punctura cannot be compiled with -ffast-math, -ffinite-math-only or /fp:fast: they remove the NaN checks that " \
    "keep a wrong force from a hand. Remove the option from files that include Punctura."
#endif

namespace punctura::detail {

/// The square root, correctly rounded, as a processor gives it. Digit by digit, with 54 bits.
constexpr double constant_sqrt(double x) noexcept {
  if (!(x > 0)) return x == 0 ? x : std::numeric_limits<double>::quiet_NaN();
  if (x > std::numeric_limits<double>::max()) return x;
  int exponent = 0;  // x * 2^exponent is a whole number of 53 or 54 bits, and the exponent is even
  for (; x < 0x1p52; x *= 4) exponent += 2;
  for (; x >= 0x1p54; x /= 4) exponent -= 2;
  const auto whole = static_cast<std::uint64_t>(x);
  std::uint64_t root = 0, rest = 0;
  for (int pair = 53; pair >= 0; --pair) {
    rest = rest << 2 | (pair >= 27 ? whole >> (2 * (pair - 27)) & 3 : 0);
    const std::uint64_t trial = root << 2 | 1;
    root <<= 1;
    if (rest < trial) continue;
    rest -= trial;
    root |= 1;
  }
  auto result = static_cast<double>((root >> 1) + (root & 1)) * 0x1p-26;  // a tie would need a root of 107 bits
  for (; exponent > 0; exponent -= 2) result /= 2;
  for (; exponent < 0; exponent += 2) result *= 2;
  return result;
}

/// sin x and cos x for |x| <= pi / 2, by their power series: to about 2 units in the last place.
struct ConstantCircle {
  double sine = 0, cosine = 0;

  constexpr explicit ConstantCircle(double x) noexcept {
    double terms[28] = {1};
    for (int i = 1; i < 28; ++i) terms[i] = terms[i - 1] * x / i;
    for (int i = 27; i >= 0; --i) (i % 2 ? sine : cosine) += i % 4 < 2 ? terms[i] : -terms[i];  // small ones first
  }
};

}  // namespace punctura::detail

namespace punctura {

/// Whether V is a single number. Specialize it for a number of your own, for example a dual number, which carries
/// derivatives. Comparisons of such a number return bool. It has the functions that `Lanes` names, and `exp`,
/// `expm1` and `log`.
template <typename V>
inline constexpr bool is_one_number = std::floating_point<V>;
/// A single number: float, double or a number of your own.
template <typename V>
concept OneNumber = is_one_number<V>;

/// A SIMD type: several numbers that are computed together, one in each lane. It needs:
///
/// - `value_type`, float or double, with an implicit conversion to the SIMD type. + - * / and unary minus, lane by
///   lane.
/// - Comparisons that return a mask. A mask has `&&`, `||`, `!` and a constructor from bool. It must not convert to
///   bool: an `if` would then apply the decision of one lane to all lanes.
/// - `select(mask, a, b)`, `any(mask)`, `all(mask)`, `min`, `max` and `sqrt`. Constructors of laws also need `tan`
///   and `cos`, and encoders `floor`. Argument-dependent lookup finds these functions. min(a, b) is b < a ? b : a, and
///   max(a, b) is a < b ? b : a.
///
/// All functions must be noexcept and must not allocate memory. Each lane then has the bits of a run with a single
/// number.
template <typename V>
concept Lanes = !OneNumber<V> && OneNumber<typename V::value_type>;

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

/// The result type of a comparison: bool, or a mask with one value for each lane.
template <typename V>
using Mask = std::remove_cvref_t<decltype(std::declval<const V&>() < std::declval<const V&>())>;

/// The functions for a single number.
///
/// The code of the model says `using namespace lane` and calls these functions without a namespace. For a SIMD type,
/// argument-dependent lookup then finds the functions of that type.
namespace lane {

template <typename T>
constexpr T select(bool mask, const T& a, const T& b) noexcept {
  return mask ? a : b;
}
constexpr bool any(bool mask) noexcept { return mask; }
constexpr bool all(bool mask) noexcept { return mask; }

using std::max;
using std::min;
// While a program is compiled, these have forms of their own. The results are the same for sqrt and abs, and within 2
// units in the last place for tan and cos, which only constructors of laws need.
template <std::floating_point T>
constexpr T sqrt(T x) noexcept {
  if (std::is_constant_evaluated()) return static_cast<T>(detail::constant_sqrt(static_cast<double>(x)));
  return std::sqrt(x);
}
template <std::floating_point T>
constexpr T abs(T x) noexcept {
  if (std::is_constant_evaluated()) return x > 0 ? x : 0 - x;
  return std::abs(x);
}
template <Lanes V>
constexpr V abs(const V& x) noexcept {
  return max(x, -x);
}
template <std::floating_point T>
constexpr bool finite(T x) noexcept {
  if (std::is_constant_evaluated()) return x <= std::numeric_limits<T>::max() && x >= std::numeric_limits<T>::lowest();
  return std::isfinite(x);
}
template <std::floating_point T>
constexpr T tan(T x) noexcept {
  if (!std::is_constant_evaluated()) return std::tan(x);
  const detail::ConstantCircle circle(x);
  return static_cast<T>(circle.sine / circle.cosine);
}
template <std::floating_point T>
constexpr T cos(T x) noexcept {
  if (!std::is_constant_evaluated()) return std::cos(x);
  return static_cast<T>(detail::ConstantCircle(x).cosine);
}
template <std::floating_point T>
T floor(T x) noexcept {
  return std::floor(x);
}
template <std::floating_point T>
T exp(T x) noexcept {
  return std::exp(x);
}
template <std::floating_point T>
T expm1(T x) noexcept {
  return std::expm1(x);
}
template <std::floating_point T>
T log(T x) noexcept {
  return std::log(x);
}

}  // namespace lane
}  // namespace punctura
