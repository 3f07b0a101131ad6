// The experiment of K06 section 4 without hardware: a simulated plant and the servo step.
#pragma once

#include <cstdint>
#include <limits>
#include <tuple>

#include "punctura/lab/plant/motion.hpp"
#include "punctura/lab/plant/plant.hpp"
#include "punctura/scene/build.hpp"
#include "punctura/servo/tick_table.hpp"

namespace punctura {

/// The record of a simulated operator and device in a tick.
struct ExperimentExtra {
  std::array<double, 3> true_position;  ///< position of the plant's tip, m
  std::array<double, 3> desired;        ///< desired position of the hand, m
};

// clang-format off
/// The fields of a tick and the fields that only an experiment has.
inline constexpr auto experiment_table = std::tuple_cat(tick_table, std::tuple{
    tick_field("true_position", "true_{a}_m", "m", use_file,
        "Where the simulated tip is, without the encoders' steps. From an experiment only",
        &ExperimentExtra::true_position),
    tick_field("desired", "desired_{a}_m", "m", use_file,
        "Where the simulated hand wants to be. From an experiment only", &ExperimentExtra::desired),
});
// clang-format on

/// A simulated operator with a simulated device. It uses the same servo step as a real device.
///
/// Motion: StrokesMotion, RecordedMotion, Target, Steered, or anything with `Desired at(double time)`, time
/// from 0.
/// Servo: a servo step, with K06's law or another model.
template <typename Motion, typename Servo = ServoStep>
class Experiment {
 public:
  /// axis: the constant direction of the stylus. Throws SceneError.
  Experiment(const Scene& scene, Motion motion, const Vector3d& axis, const DeviceDynamics& device = {},
             const Hand& hand = {}, std::uint64_t seed = 0)
      : Experiment(build(scene), 1 / scene.servo.rate, std::move(motion), axis, device, hand, seed) {}

  /// servo: before its first tick, with the period (s).
  Experiment(Servo servo, double period, Motion motion, const Vector3d& axis, const DeviceDynamics& device = {},
             const Hand& hand = {}, std::uint64_t seed = 0)
      : servo_(std::move(servo)),
        plant_(device, hand, period, seed),
        motion_(std::move(motion)),
        axis_(to_array(axis.stableNormalized())),
        period_(period) {
    plant_.place(motion_.at(0).position);
    servo_.arm();
  }

  /// One servo period: reads the encoders, computes the force and holds it while the plant moves.
  const Snapshot& step() noexcept {
    const double time = static_cast<double>(tick_) * period_;
    desired_ = motion_.at(time);
    const Snapshot& snapshot = servo_.step({tick_, time, to_array(plant_.measured()), axis_, 0, true});
    tip_ = plant_.tip();
    plant_.step(to_vector(snapshot.force), desired_);
    ++tick_;
    return snapshot;
  }

  /// The true and the desired position of the last step.
  ExperimentExtra extra() const noexcept { return {to_array(tip_), to_array(desired_.position)}; }
  const Desired& desired() const noexcept { return desired_; }  ///< desired motion of the last step
  const Vector3d& tip() const noexcept { return tip_; }         ///< true position of the tip in the last step, m
  Motion& motion() noexcept { return motion_; }
  Servo& servo() noexcept { return servo_; }
  std::uint64_t ticks() const noexcept { return tick_; }  ///< number of ticks so far

  /// For save_state() and load_state() (state/archive.hpp). Motion also needs `archive` and `describe`. The results of
  /// the last step are not loaded.
  static void archive(auto& self, auto& state) { state.fields(self.servo_, self.plant_, self.motion_, self.tick_); }
  void describe(auto& parameters) const {
    servo_.describe(parameters);
    plant_.describe(parameters);
    motion_.describe(parameters);
    parameters.fields(axis_[0], axis_[1], axis_[2], period_);
  }

 private:
  Servo servo_;
  Plant plant_;
  Motion motion_;
  std::array<double, 3> axis_;
  double period_;
  std::uint64_t tick_ = 0;
  Desired desired_{Vector3d::Zero(), Vector3d::Zero()};
  Vector3d tip_ = Vector3d::Zero();
};

}  // namespace punctura
