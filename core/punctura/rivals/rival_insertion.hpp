// A needle through several layers, each with a rival: the same interface as InsertionOf, so a servo step can run it.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "punctura/insertion/conditioned_proxies.hpp"
#include "punctura/proxy/in_space.hpp"
#include "punctura/rivals/friction_alone.hpp"
#include "punctura/rivals/puncturing.hpp"
#include "punctura/scene/build.hpp"

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
  static void for_each_kind(auto&& act) {
    [&]<std::size_t... i>(std::index_sequence<i...>) {
      (act(std::variant_alternative_t<i, Kinds>{}.rival), ...);
    }(std::make_index_sequence<std::variant_size_v<Kinds>>());
  }

  auto visit(auto&& act) { return std::visit(act, kind); }
  auto visit(auto&& act) const { return std::visit(act, kind); }

  double step(double depth, double velocity, double period) noexcept {
    return std::visit([&](auto& run) noexcept { return run.step(depth, velocity, period); }, kind);
  }
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

/// Adds a problem for each number of a rival that is outside its bounds.
inline void check(const AnyRival& rival, const std::string& path, std::vector<Problem>& problems) {
  rival.visit([&](const auto& run) {
    for (const auto& number : run.rival.numbers())
      if (const double value = run.rival.*number.value; !(value >= number.low && value <= number.high))
        problems.push_back(
            {path + "." + number.name, value,
             "must be between " + decimal_text(number.low) + " and " + decimal_text(number.high) + " " + number.unit});
  });
}

/// A rival in the place of a Proxy3d. At entry from the front it fixes b, the needle's direction, as K06 (41) does.
/// Inside it has the depth along b and the velocity along b, which is the difference of the last two positions over T.
class RivalProxy {
 public:
  using Scalar = double;
  using Vector = Vector3d;
  struct State {
    bool started = false;
    Phase phase = Phase::barred;
    Vector p{};  ///< last position, m
    Vector b{};  ///< the needle's direction at entry
    double cos_beta = 1;
  };

  /// point: a, any point of the surface, m. inward_normal: n, of length 1. period: T, s.
  RivalProxy(const AnyRival& rival, const Vector& point, const Vector& inward_normal, double period) noexcept
      : rival_(rival), a_(point), n_(inward_normal), period_(period) {
    reset();
  }

  /// Clears the state. A needle that starts inside gets no force until it has been outside, in front.
  void reset() noexcept {
    rival_.reset();
    state_ = {};
    tick_ = {};
    tick_.phase = state_.phase;
  }
  bool same_place(const RivalProxy& other) const noexcept { return a_ == other.a_ && n_ == other.n_; }
  /// Another rival than before begins with an untouched layer.
  void resume(const RivalProxy& previous) noexcept {
    rival_.visit([&]<typename Run>(Run& run) noexcept {
      const Run* old = std::get_if<Run>(&previous.rival_.kind);
      run.state = old ? old->state : Run{}.state;
    });
    state_ = previous.state_;
    tick_ = previous.tick_;
  }

  /// One tick. p: conditioned position, m. axis: the needle's unit direction. Returns the force on the device, N.
  const Vector& step_finite(const Vector& p, const Vector& axis) noexcept {
    const double along_normal = n_.dot(p - a_);
    if (along_normal <= 0)
      state_.phase = Phase::outside;
    else if (state_.phase == Phase::outside)
      enter(axis);
    const double velocity = state_.started ? state_.b.dot(p - state_.p) / period_ : 0;
    state_.p = p;
    state_.started = true;
    if (!inside(state_.phase)) {
      rival_.reset();
      tick_ = {{}, p, state_.b, 0, along_normal, {0, 0}, state_.phase};
      return tick_.force;
    }
    const double depth = along_normal / state_.cos_beta, force = -rival_.step(depth, velocity, period_);
    state_.phase = velocity > 0 ? Phase::sliding_in : velocity < 0 ? Phase::sliding_out : Phase::sticking;
    tick_ = {state_.b * force, p, state_.b, force, depth, {force, force}, state_.phase};
    return tick_.force;
  }

  static void archive(auto& self, auto& state) {
    state.fields(self.rival_, self.state_.started);
    state.choice(self.state_.phase, Phase::barred);
    state.fields(self.state_.p, self.state_.b, self.state_.cos_beta, self.tick_);
    if (inside(self.state_.phase))
      state.require(self.state_.started && is_unit(self.state_.b) && self.state_.cos_beta >= grazing_cosine<double>);
  }
  void describe(auto& parameters) const {
    rival_.describe(parameters);
    parameters.fields(a_, n_, period_);
  }

  const SpaceTick<double>& tick() const noexcept { return tick_; }  ///< its band is the force on both edges
  const State& state() const noexcept { return state_; }
  Phase phase() const noexcept { return state_.phase; }
  double depth() const noexcept { return tick_.depth; }

 private:
  void enter(const Vector& axis) noexcept {
    const double cos_beta = n_.dot(axis);
    state_.phase = cos_beta >= grazing_cosine<double> ? Phase::sticking : Phase::barred;
    if (state_.phase == Phase::barred) return;
    state_.b = axis;
    state_.cos_beta = cos_beta;
  }

  AnyRival rival_;
  Vector a_, n_;
  double period_;
  State state_{};
  SpaceTick<double> tick_{};
};

/// The force of rivals at the places of a scene's membranes. Conditioning and sub-steps are those of K06.
///
/// `ServoStepOf<RivalInsertion>` is a whole tick: the same gate and the same force limits as for K06.
class RivalInsertion : public ConditionedProxies<double, std::vector<RivalProxy>, HeapStorage> {
 public:
  /// rivals: one for each membrane of a scene that has passed check(), or one for all.
  RivalInsertion(const Scene& scene, std::span<const AnyRival> rivals)
      : ConditionedProxies(1 / scene.servo.rate, scene.servo.low_pass, scene.direction, scene.servo.conditioning,
                           scene.servo.encoder_step, static_cast<std::uint32_t>(scene.servo.sub_steps)) {
    const double period = 1 / scene.servo.rate / scene.servo.sub_steps;
    for (std::size_t i = 0; i < scene.membranes.size(); ++i) {
      const PlacedMembrane& at = scene.membranes[i];
      proxies_.emplace_back(rivals[rivals.size() == 1 ? 0 : i], to_vector(at.point),
                            to_vector(at.inward_normal).stableNormalized(), period);
    }
    reset();
  }
};

using RivalServoStep = ServoStepOf<RivalInsertion>;

/// The model of a scene with rivals in place of K06's law: one for each membrane, or one for all. Empty if there are
/// problems, which are added to `problems`.
inline std::optional<RivalInsertion> try_build_rivals(const Scene& scene, std::span<const AnyRival> rivals,
                                                      std::vector<Problem>& problems) {
  auto found = check(scene);
  if (rivals.size() != 1 && rivals.size() != scene.membranes.size())
    found.push_back({"rivals", static_cast<double>(rivals.size()),
                     "must be one rival, or one for each of the " + std::to_string(scene.membranes.size()) +
                         " membranes of the scene"});
  for (std::size_t i = 0; i < rivals.size(); ++i) check(rivals[i], "rivals[" + std::to_string(i) + "]", found);
  return detail::if_good(found, problems, [&] { return RivalInsertion(scene, rivals); });
}

#if defined(__cpp_exceptions)
/// The whole tick of a scene with rivals: the same input gate, force limits and syringe as the scene has with K06. An
/// automatic force scale follows from the rivals' own forces. Throws SceneError.
inline RivalServoStep build_rivals(const Scene& scene, std::span<const AnyRival> rivals, const GateLimits& gate = {},
                                   const ForceLimits& limits = {}) {
  return detail::or_throw([&](auto& problems) {
    return detail::step_of(scene, try_build_rivals(scene, rivals, problems), problems, gate, limits);
  });
}
#endif

}  // namespace punctura
