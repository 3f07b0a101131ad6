// The two ways to solve K06 (21)-(23), and the state a membrane can be in.
#pragma once

#include <cstdint>

#include "punctura/model/lane.hpp"

namespace punctura {

enum class Solver : std::uint8_t {
  paper,  ///< K06 (33): the band is taken at q*, which stands for q (31)
  exact,  ///< the true solution of (21)-(23)
};

/// What the needle is doing in one membrane.
enum class Phase : std::uint8_t {
  outside,
  sticking,     ///< the proxy rests: the force is inside the band
  sliding_in,   ///< the force is on the lower edge
  sliding_out,  ///< the force is on the upper edge
  barred,       ///< inside, but not entered from the front: no force until the tip has been outside, in front
};

/// Whether friction acts.
constexpr bool inside(Phase phase) noexcept { return phase != Phase::outside && phase != Phase::barred; }

/// A phase for each lane, as its number: a small whole number has its exact place in every floating-point type.
template <Lanes V>
struct Phases {
  V number{};

  Phases() = default;
  explicit Phases(const V& numbers) noexcept : number(numbers) {}
  Phases(Phase phase) noexcept : number(static_cast<Lane<V>>(phase)) {}

  auto operator==(Phase phase) const noexcept { return number == Phases(phase).number; }
};

template <typename V>
auto inside(const Phases<V>& phase) noexcept {
  return !(phase == Phase::outside) && !(phase == Phase::barred);
}
template <typename M, Lanes V>
Phases<V> select(const M& mask, const Phases<V>& a, const Phases<V>& b) noexcept {
  return Phases<V>(select(mask, a.number, b.number));
}

/// What stands for the phase of one number or of several.
template <typename V>
struct PhaseFor {
  using type = Phases<V>;
};
template <OneNumber V>
struct PhaseFor<V> {
  using type = Phase;
};
template <typename V>
using PhaseOf = typename PhaseFor<V>::type;

}  // namespace punctura
