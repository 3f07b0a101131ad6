// One tick, from the sample of the device to the force for the device. Read this first.
//
//   device -> input gate -> conditioning -> proxy 1..n -> sum -> force scale -> force limits -> device
//                |          '--------- Insertion ---------'                           |
//                +----------------- fault (latched) -> zero force <-------------------+
//
// A tick throws nothing, allocates no memory, takes no lock and writes no log.
#pragma once

#include <algorithm>
#include <concepts>
#include <cstddef>
#include <cstdlib>
#include <limits>
#include <optional>
#include <type_traits>
#include <utility>

#include "punctura/insertion/needle_syringe.hpp"
#include "punctura/insertion/scene_insertion.hpp"
#include "punctura/safety/force_limits.hpp"
#include "punctura/safety/input_gate.hpp"
#include "punctura/servo/snapshot.hpp"
#include "punctura/state/archive.hpp"

namespace punctura {

/// The model of a tick, behind the guard: an InsertionOf, or a class of your own.
///
/// step(position, axis) returns the force on the device, N. position: m. axis: the needle's unit direction, read only
/// if uses_axis(). tick(i), cos_beta(i): of the last tick at membrane i, of size() membranes. outside(): the tip is in
/// front of all of them. resume(previous) takes over another model of this type during a run.
///
/// All of it is noexcept: an exception in a tick would end the program, and the device would hold its last force.
template <typename M>
concept Model = requires(M model, const M& now, const Vector3<typename M::Scalar>& vector, std::size_t i) {
  typename M::StoredIn;  // HeapStorage, or FixedStorage
  { model.reset() } noexcept;
  { model.resume(model) } noexcept;
  { model.step(vector, vector) } noexcept -> std::convertible_to<Vector3<typename M::Scalar>>;
  { now.tip() } noexcept -> std::convertible_to<Vector3<typename M::Scalar>>;
  { now.uses_axis() } noexcept -> std::same_as<bool>;
  { now.outside() } noexcept -> std::same_as<bool>;
  { now.size() } noexcept -> std::same_as<std::size_t>;
  { now.tick(i) } noexcept -> std::convertible_to<SpaceTick<typename M::Scalar>>;
  { now.cos_beta(i) } noexcept -> std::same_as<typename M::Scalar>;
};

/// Everything of a servo step but its model: input gate, force scale, force limits, fault, fade, syringe and record.
///
/// No model goes around it: step() asks a model for its force, and only step() makes the force for the device.
/// Scalar: that of the model. The record is double.
template <typename Scalar_, typename Storage = HeapStorage>
class ServoGuard {
 public:
  using Scalar = Scalar_;
  using Vector = Vector3<Scalar>;
  using Syringe = NeedleSyringe<Scalar, Storage>;

  /// Puts a syringe on the needle. Before the first tick.
  constexpr void set_syringe(const Syringe& syringe) { syringe_ = syringe; }

  /// Requests force. The force starts when the tip is in front of every membrane, with a ramp of
  /// ForceLimits::ramp_time.
  ///
  /// It does not clear a latched fault: only reset() does.
  constexpr void arm() noexcept {
    commands_ |= command_arm;
    if (state_ == ServoState::disarmed) state_ = ServoState::waiting;
  }

  /// Ends the force immediately.
  constexpr void disarm() noexcept {
    commands_ |= command_disarm;
    if (state_ != ServoState::faulted) state_ = ServoState::disarmed;
  }

  static constexpr Scalar fade_time = Scalar(0.2);  ///< s

  /// How much the motors have given and not yet recovered from, N^2 s. See ForceBudget. The next run must continue
  /// with it.
  constexpr Scalar spent() const noexcept { return limiter_.budget().spent(); }
  constexpr void set_spent(Scalar spent) noexcept {
    limiter_.set_spent(spent);
    time_ = std::numeric_limits<double>::quiet_NaN();  // the time since the last run does not count as rest
  }
  /// Ends a run. The device has held the last force for `elapsed` (s) and now gives no force.
  constexpr void end(Scalar elapsed) noexcept { limiter_.end(elapsed); }

  /// Takes over the run of another step of the same period, but not its model: limits, budget, state, fault and number
  /// of the tick go on, and the force is faded. The model begins afresh: it gives no force until the tip has been in
  /// front of every membrane. A syringe goes on if it has the same contents, barrel and coupling; another one starts
  /// full, where the thumb is.
  constexpr void resume(const ServoGuard& previous) noexcept {
    if (syringe_ && previous.syringe_ && syringe_->plunger.same_syringe(previous.syringe_->plunger))
      syringe_->plunger.state = previous.syringe_->plunger.state;
    gate_.state = previous.gate_.state;
    limiter_.state = previous.limiter_.state;
    limiter_.set_spent(previous.spent());
    state_ = previous.state_;
    fault_ = previous.fault_;
    tick_ = previous.tick_;
    time_ = previous.time_;
    commands_ = previous.commands_ | command_scene;
    faded_force_ = previous.faded_force_;
    thumb_force_ = previous.thumb_force_;
    start_fade();
    barred_ = true;
  }

  /// The force for the device under the thumb, before its own limits, N; negative while the thumb pushes. 0 unless the
  /// step is active.
  constexpr Scalar thumb_force() const noexcept { return thumb_force_; }
  constexpr const Snapshot& snapshot() const noexcept { return snapshot_; }
  constexpr Scalar force_scale() const noexcept { return force_scale_; }
  constexpr const std::optional<Syringe>& syringe() const noexcept { return syringe_; }
  constexpr ServoState state() const noexcept { return state_; }
  constexpr Fault fault() const noexcept { return fault_; }

 protected:
  /// model: the insertion behind this guard. The other arguments are those of ServoStepOf.
  template <typename Insertion>
  constexpr ServoGuard(const Insertion& model, Scalar period, const GateLimits& gate, const ForceLimits& limits,
                       Scalar force_scale)
      : gate_(gate, period, model.uses_axis()),
        limiter_(limits, period),
        force_scale_(force_scale),
        fade_step_(period / fade_time) {
    if (model.size() > max_membranes || !(force_scale > 0 && force_scale <= 1)) std::abort();
    snapshot_.membrane_count = static_cast<std::uint32_t>(model.size());
  }

  constexpr void reset() noexcept {
    commands_ = (commands_ & command_scene) | command_reset;
    fade_ = 0;
    barred_ = false;
    if (syringe_) syringe_->plunger.reset();
    gate_.state = {};
    fault_ = Fault::none;
    state_ = ServoState::disarmed;
  }

  /// One tick with the force of this model.
  template <typename Insertion>
  constexpr const Snapshot& step(Insertion& model, const DeviceSample& sample) noexcept {
    if (fault_ == Fault::none) fault_ = gate_.step(sample);

    Vector model_force = Vector::Zero(), force = Vector::Zero();
    if (fault_ == Fault::none) {
      model_force = model.step(to_vector(sample.position).template cast<Scalar>(),
                               to_vector(sample.axis).template cast<Scalar>().stableNormalized());
      if (!model_force.allFinite() || !bands_are_finite(model) ||
          (syringe_ && !lane::finite(syringe_->step(static_cast<Scalar>(sample.thumb), model))))
        fault_ = Fault::non_finite_force;
    }
    if (fault_ != Fault::none) state_ = ServoState::faulted;
    if (barred_ && model.outside()) {
      barred_ = false;
      start_fade();
    }
    if (fault_ != Fault::none || barred_) model_force.setZero();
    if (state_ == ServoState::active && !gate_.held(sample)) state_ = ServoState::waiting;
    if (state_ == ServoState::waiting && model.outside() && gate_.held(sample)) {
      state_ = ServoState::active;
      limiter_.reset();
    }
    // NaN or negative after a fault of the clock or at the start of a run. While it compiles, Clang subtracts no NaN.
    auto elapsed = static_cast<Scalar>(time_);
    if (!std::is_constant_evaluated() || lane::finite(time_)) elapsed = static_cast<Scalar>(sample.time - time_);
    const auto temperature = static_cast<Scalar>(sample.motor_temperature);
    if (lane::finite(sample.time)) time_ = sample.time;
    thumb_force_ = state_ == ServoState::active ? faded_thumb() : Scalar(0);
    if (state_ == ServoState::active) {
      force = limiter_.step(faded(force_scale_ * model_force), temperature, elapsed);
      if (!force.allFinite()) {  // impossible with limits that passed check(), but safety must not depend on that
        fault_ = Fault::non_finite_force;
        state_ = ServoState::faulted;
        force.setZero();
        thumb_force_ = 0;
      }
    } else {
      limiter_.rest(temperature, elapsed);
      faded_force_.setZero();
      fade_ = 0;
    }
    record(model, sample, model_force, force);
    return snapshot_;
  }

  static void archive(auto& self, auto& state) {
    if (self.syringe_) state.fields(*self.syringe_);
    state.fields(self.gate_, self.limiter_);
    state.choice(self.state_, ServoState::faulted);
    state.choice(self.fault_, Fault::thumb);
    state.require((self.state_ == ServoState::faulted) == (self.fault_ != Fault::none));
    state.fields(self.tick_, self.commands_);
    archive_or_nan(self.time_, state);
    state.fields(self.fade_, self.faded_force_, self.fade_offset_, self.thumb_force_, self.thumb_offset_,
                 self.fade_starts_, self.barred_);
    state.require(self.fade_ >= 0 && self.fade_ <= 1);
  }
  void describe(auto& parameters) const {
    parameters.flag(syringe_.has_value());
    if (syringe_) syringe_->describe(parameters);
    gate_.describe(parameters);
    limiter_.describe(parameters);
    parameters.fields(force_scale_, fade_step_);
  }

  bool barred_ = false;  ///< the model is another than before, and the tip has not been in front of it yet

 private:
  /// Whether each band is finite. Where a law of the user's own gives NaN, a proxy holds the needle with its coupling,
  /// and the force stays finite; the band of a law with a flaw is NaN (no_band). check() has seen the bands of a
  /// scene's own laws, in double.
  template <typename Insertion>
  constexpr bool bands_are_finite([[maybe_unused]] const Insertion& model) const noexcept {
    if constexpr (std::is_same_v<Insertion, BasicInsertion<double>>) return true;
    Scalar sum = 0;  // NaN if a band is not finite
    for (std::uint32_t i = 0; i < snapshot_.membrane_count; ++i) {
      const auto& band = model.tick(i).band;
      sum += 0 * band.lower + 0 * band.upper;
    }
    return sum == 0;
  }

  /// The plunger's force on the thumb, scaled, and faded as the needle's force. Call it before faded().
  constexpr Scalar faded_thumb() noexcept {
    const Scalar wanted = syringe_ ? force_scale_ * syringe_->plunger.force() : Scalar(0);
    if (fade_starts_) thumb_offset_ = thumb_force_ - wanted;
    return wanted + fade_ * thumb_offset_;
  }

  constexpr void start_fade() noexcept {
    fade_ = 1;
    fade_starts_ = true;
  }
  /// Fades from the force before start_fade() to the wanted force.
  constexpr Vector faded(const Vector& wanted) noexcept {
    if (fade_starts_) fade_offset_ = faded_force_ - wanted;
    fade_starts_ = false;
    faded_force_ = wanted + fade_ * fade_offset_;
    fade_ = std::max(Scalar(0), fade_ - fade_step_);
    return faded_force_;
  }

  /// The plunger gives no force on the thumb in a fault.
  constexpr SyringeRecord syringe_record() const noexcept {
    if (!syringe_) return no_syringe;
    const auto& plunger = syringe_->plunger;
    const auto wide = [](Scalar x) { return static_cast<double>(x); };
    return {wide(plunger.position()), fault_ == Fault::none ? wide(plunger.force()) : 0, wide(plunger.pressure()),
            wide(plunger.left())};
  }

  template <typename Insertion>
  constexpr void record(const Insertion& model, const DeviceSample& sample, const Vector& model_force,
                        const Vector& force) noexcept {
    snapshot_.tick = tick_++;
    snapshot_.sample = sample;
    snapshot_.tip = to_array(model.tip());
    snapshot_.model_force = to_array(model_force);
    snapshot_.force = to_array(force);
    snapshot_.force_scale = force_scale_;
    snapshot_.ceiling = limiter_.ceiling();
    snapshot_.limits = limiter_.counters();
    snapshot_.limit = limiter_.limit();
    snapshot_.syringe = syringe_record();
    snapshot_.commands = std::exchange(commands_, 0);
    snapshot_.state = state_;
    snapshot_.fault = fault_;
    for (std::uint32_t i = 0; i < snapshot_.membrane_count; ++i) snapshot_.membranes[i] = record_of(model.tick(i));
  }

  std::optional<Syringe> syringe_;
  BasicInputGate<Scalar> gate_;
  BasicForceLimiter<Scalar> limiter_;
  ServoState state_ = ServoState::disarmed;
  Fault fault_ = Fault::none;
  std::uint64_t tick_ = 0;
  std::uint32_t commands_ = 0;
  double time_ = std::numeric_limits<double>::quiet_NaN();  ///< time of the last sample in this run, s
  Scalar force_scale_;
  Scalar fade_step_, fade_ = 0;
  bool fade_starts_ = false;
  Vector faded_force_{}, fade_offset_{};
  Scalar thumb_force_ = 0, thumb_offset_ = 0;
  Snapshot snapshot_{};
};

/// The servo step: input gate, model, force scale, force limits and the record of a tick.
///
/// Insertion: the BasicInsertion of a scene, an InsertionOf with your own laws and coupling, or any other Model. A tick
/// is computed in its Scalar.
template <Model Insertion>
class ServoStepOf : public ServoGuard<typename Insertion::Scalar, typename Insertion::StoredIn> {
 public:
  using Guard = ServoGuard<typename Insertion::Scalar, typename Insertion::StoredIn>;
  using typename Guard::Scalar;

  /// Prefer build() (scene/build.hpp): it checks the scene first. period: T, s. force_scale: how much of the model's
  /// force the device gives. The program aborts if it is not greater than 0 and at most 1, or if insertion has more
  /// than max_membranes membranes.
  constexpr ServoStepOf(Insertion insertion, Scalar period, const GateLimits& gate = {}, const ForceLimits& limits = {},
                        Scalar force_scale = 1)
      : Guard(insertion, period, gate, limits, force_scale), insertion_(std::move(insertion)) {}

  /// Clears a fault and the state of gate and model. The step is then disarmed.
  constexpr void reset() noexcept {
    insertion_.reset();
    Guard::reset();
  }

  /// Takes over the run of another step of the same period. Use it to change the scene while somebody holds the device.
  ///
  /// Membranes at the same place keep their proxies. The change of the force, also by another force scale, is faded in
  /// over `fade_time`, so that the hand feels no jump. Allocates no memory. Do not use `previous` afterwards.
  constexpr void resume(ServoStepOf& previous) noexcept {
    insertion_.resume(previous.insertion_);
    Guard::resume(previous);
    this->barred_ = previous.barred_;
  }

  /// One tick. Returns its record; `force` in it is the force for the device. The record is valid until the next step.
  constexpr const Snapshot& step(const DeviceSample& sample) noexcept { return Guard::step(insertion_, sample); }

  constexpr const Insertion& insertion() const noexcept { return insertion_; }

  /// For save_state() and load_state() (state/archive.hpp). The snapshot stays that of this object's last tick.
  /// A loaded step may be active: it gives force in its first tick.
  static void archive(auto& self, auto& state) {
    Insertion::archive(self.insertion_, state);
    Guard::archive(self, state);
  }
  void describe(auto& parameters) const {
    insertion_.describe(parameters);
    Guard::describe(parameters);
  }

 private:
  Insertion insertion_;
};

/// The servo step of a scene.
template <typename Scalar>
using BasicServoStep = ServoStepOf<BasicInsertion<Scalar>>;
using ServoStep = BasicServoStep<double>;
using ServoStepF = BasicServoStep<float>;

}  // namespace punctura
