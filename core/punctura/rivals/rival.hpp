// The requirements on a rival: a force model from the literature without a band of friction, to compare with K06.
//
// docs/rivals.md has the equations, the sources, and what each rival leaves out.
#pragma once

#include <array>
#include <concepts>
#include <string_view>
#include <type_traits>

#include "punctura/model/field.hpp"

namespace punctura {

/// What a trace must contain so that a number of a rival can be read from it.
enum class Shows { insertion, withdrawal, speeds, setting };
template <>
inline constexpr std::array<std::string_view, 4> words_of<Shows>{"insertion", "withdrawal", "speeds", "nothing"};

/// A number of a rival R.
template <typename R>
struct RivalNumber {
  double R::* value;
  const char* name;
  const char* unit;
  double low, high;  ///< bounds, for every use of the rival
  const char* what;
  Shows shows = Shows::insertion;  ///< Shows::setting: a setting, which is never fitted
};

/// A force model of one needle in one layer of tissue. State{} is a needle in front of it.
///
/// resistance() returns the force against the insertion, N: positive while the needle goes in. depth: m, below the
/// surface, greater than 0. velocity: m/s, positive inwards. period: time since the last call, s. It throws nothing and
/// allocates no memory.
template <typename R>
concept Rival = requires(const R rival, typename R::State& state, double x) {
  requires std::is_trivially_copyable_v<R> && std::is_trivially_copyable_v<typename R::State>;
  { R::name } -> std::convertible_to<const char*>;
  { R::title } -> std::convertible_to<const char*>;
  { R::source } -> std::convertible_to<const char*>;
  R::numbers();
  { rival.resistance(state, x, x, x) } noexcept -> std::same_as<double>;
};

/// A rival whose tissue is punctured when load() reaches `puncture`. load() belongs to the last call of resistance().
template <typename R>
concept Punctures = Rival<R> && requires(const R rival, const typename R::State state, double depth) {
  { rival.puncture } -> std::convertible_to<double>;
  { rival.load(state, depth) } noexcept -> std::same_as<double>;
  { state.punctured } -> std::convertible_to<bool>;
};

}  // namespace punctura
