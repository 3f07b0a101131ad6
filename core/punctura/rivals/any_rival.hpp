// One of the rivals, with its state.
#pragma once

#include <optional>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>

#include "punctura/rivals/elastic.hpp"
#include "punctura/rivals/friction_alone.hpp"
#include "punctura/rivals/mahvash_dupont.hpp"
#include "punctura/rivals/okamura.hpp"

namespace punctura {

/// A rival and its state in one layer of tissue.
template <Rival R>
struct RivalRun {
  R rival{};
  typename R::State state{};

  /// depth: m, below the surface. velocity: m/s, positive inwards. period: s. Returns the force against the insertion,
  /// N. In front of the surface it is 0, and the layer is untouched again.
  double step(double depth, double velocity, double period) noexcept {
    if (!(depth > 0)) {
      state = {};
      return 0;
    }
    return rival.resistance(state, depth, velocity, period);
  }
};

/// Any of the rivals. It is plain data: a copy continues with the same results.
class AnyRival {
 public:
  using Kinds = std::variant<RivalRun<Okamura>, RivalRun<Gordon>, RivalRun<Exponential>, RivalRun<HuntCrossley>,
                             RivalRun<KelvinVoigt>, RivalRun<MahvashDupont>, RivalRun<Dahl>, RivalRun<StickSlip>,
                             RivalRun<SignOfVelocity>>;

  Kinds kind;
  explicit AnyRival(const Kinds& of) noexcept : kind(of) {}

  /// The rival of this name with its default numbers; empty for an unknown name.
  static std::optional<AnyRival> named(std::string_view name) {
    std::optional<AnyRival> found;
    for_each_kind([&]<typename R>(R rival) {
      if (name == R::name) found.emplace(Kinds(RivalRun<R>{rival, {}}));
    });
    return found;
  }
  /// Calls act(R{}) for each rival R.
  static void for_each_kind(auto&& act) {
    [&]<std::size_t... i>(std::index_sequence<i...>) {
      (act(std::variant_alternative_t<i, Kinds>{}.rival), ...);
    }(std::make_index_sequence<std::variant_size_v<Kinds>>());
  }

  auto visit(auto&& act) { return std::visit(act, kind); }
  auto visit(auto&& act) const { return std::visit(act, kind); }

  /// See RivalRun::step().
  double step(double depth, double velocity, double period) noexcept {
    return std::visit([&](auto& run) noexcept { return run.step(depth, velocity, period); }, kind);
  }
  /// An untouched layer.
  void reset() noexcept {
    std::visit([](auto& run) noexcept { run.state = {}; }, kind);
  }

  static void archive(auto& self, auto& state) {
    std::visit([&](auto& run) { std::remove_cvref_t<decltype(run.state)>::archive(run.state, state); }, self.kind);
  }
  void describe(auto& parameters) const {
    parameters.index(kind.index(), 0);
    visit([&](const auto& run) {
      for (const auto& number : run.rival.numbers()) parameters.fields(run.rival.*number.value);
    });
  }
};
static_assert(std::is_trivially_copyable_v<AnyRival>);

}  // namespace punctura
