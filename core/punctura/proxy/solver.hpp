// The two solvers of K06 (21)-(23), and the phases of a needle in a membrane.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "punctura/model/field.hpp"
#include "punctura/model/lane.hpp"

namespace punctura {

/// How a tick solves K06 (21)-(23).
enum class Solver : std::uint8_t {
  paper,  ///< K06 (33): q* approximates q (31), and the band is taken at q*
  exact,  ///< the true solution of (21)-(23)
};
template <>
inline constexpr std::array<std::string_view, 2> words_of<Solver>{"paper", "exact"};

enum class Phase : std::uint8_t {
  outside,      ///< in front of the surface: no force
  sticking,     ///< the proxy rests: the force is inside the band
  sliding_in,   ///< the proxy moves in: the force is on the lower edge
  sliding_out,  ///< the proxy moves out: the force is on the upper edge
  barred,       ///< inside without a valid entry: no force until the tip has been outside, in front
};
template <>
inline constexpr std::array<std::string_view, 5> words_of<Phase>{"outside", "sticking", "sliding_in", "sliding_out",
                                                                 "barred"};

/// Whether friction acts in this phase.
constexpr bool inside(Phase phase) noexcept { return phase != Phase::outside && phase != Phase::barred; }

/// A phase for each lane, stored as a number. Floating-point types represent small integers exactly.
template <Lanes V>
struct Phases {
  V number{};

  Phases() = default;
  constexpr explicit Phases(const V& numbers) noexcept : number(numbers) {}
  constexpr Phases(Phase phase) noexcept : number(static_cast<Lane<V>>(phase)) {}

  auto operator==(Phase phase) const noexcept { return number == Phases(phase).number; }
};

template <typename V>
constexpr auto inside(const Phases<V>& phase) noexcept {
  return phase.number > Phases<V>(Phase::outside).number && phase.number < Phases<V>(Phase::barred).number;
}
template <typename M, Lanes V>
constexpr Phases<V> select(const M& mask, const Phases<V>& a, const Phases<V>& b) noexcept {
  return Phases<V>(select(mask, a.number, b.number));
}

/// The type of a phase: Phase for one number, Phases for lanes.
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
