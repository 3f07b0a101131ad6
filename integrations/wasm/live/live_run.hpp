// A scene on a simulated device, in a page without a server: ticks in blocks, on a clock of their own.
//
// The tick is the servo step of the core. Device and hand are the plant of the core. What is here is what the runtime's
// SimulatedDevice and ServoLoop do around them on a thread, which a page does not have.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "estimator.hpp"
#include "json.hpp"
#include "other_solver.hpp"
#include "punctura/lab/events/event_finder.hpp"
#include "punctura/lab/plant/motion.hpp"
#include "punctura/lab/plant/plant.hpp"
#include "punctura/lab/plant/stroke_ends.hpp"
#include "punctura/scene/build.hpp"
#include "punctura/syringe/plunger.hpp"

namespace punctura::live {

class LiveRun {
 public:
  /// The limits for a simulated device: nobody holds it, so a pause of the page need not stop it.
  static constexpr GateLimits gate{.stale = 1, .deadline = 1};
  static constexpr ForceLimits limits{};
  static constexpr DeviceDynamics device{};

  /// number: of the run. pose: of the hand; without one, the scene's resting pose. Empty, with the problems, if the
  /// scene has some.
  static std::unique_ptr<LiveRun> make(Scene scene, std::uint32_t number, std::uint64_t seed,
                                       const std::optional<HandPose>& pose, std::vector<Problem>& problems);

  /// Before the first tick: the motors have spent what they had in the run before.
  void go_on_from(const LiveRun& before) noexcept { step_.set_spent(before.step_.spent()); }
  void arm() noexcept { step_.arm(); }
  void pause() noexcept { step_.disarm(); }
  void reset() noexcept;
  /// The next reading of the device has a position that is not a number.
  void trip() noexcept { trips_ = true; }
  /// The target of the hand, m; the unit direction of the stylus; the buttons.
  void target(const HandPose& pose, std::uint32_t buttons) noexcept;
  /// Strokes through all membranes and back until the next target. period: of one stroke in and out, s.
  void strokes(double period);
  bool strokes_now() const noexcept { return strokes_.has_value(); }
  void push_plunger(double force) noexcept { wanted_thumb_ = std::min(force, strongest_thumb); }

  /// Exchanges the scene between two ticks; the force fades over. Returns false, with the problems, and changes nothing
  /// if the scene has some. The rate stays.
  bool exchange(Scene scene, std::vector<Problem>& problems);
  void compare(bool on);
  void estimate(bool on);

  /// Makes this many ticks. Returns their frame.
  const std::vector<std::byte>& advance(std::size_t count);
  /// Makes a tick with a given reading instead of the simulated device's. Returns its frame.
  const std::vector<std::byte>& feed(const Vector3d& position, const Vector3d& axis);

  /// The messages since the last call, as a JSON array: events, laws, estimates.
  std::string messages();
  /// The scene for the page, as a JSON object.
  std::string scene() const;
  const HandPose& pose() const noexcept { return pose_; }
  double rate() const noexcept { return rate_; }

 private:
  LiveRun(Scene scene, BasicServoStep<double> step, std::uint32_t number, std::uint64_t seed, const HandPose& pose);
  static Scene fitted(Scene scene, double rate);
  DeviceSample reading();
  Vector3d tick(DeviceSample sample);
  double thumb_depth() noexcept;
  const std::vector<std::byte>& frame(std::size_t count);
  void watch(const Snapshot& snapshot);
  void watch_axis(const Snapshot& snapshot);
  Json& message();

  Scene scene_;
  double rate_;
  BasicServoStep<double> step_;
  std::uint32_t number_;
  int scenes_ = 0;  ///< exchanged so far
  HandPose pose_;
  std::uint32_t buttons_ = 0;
  Target target_;
  std::optional<StrokesMotion> strokes_;
  double strokes_began_ = 0, stroke_period_ = 0;  ///< s
  Plant plant_;
  std::uint64_t ticks_ = 0;
  bool trips_ = false;
  double thumb_ = 0, wanted_thumb_ = not_given;  ///< m; N, NaN before the first push

  EventFinder finder_;
  std::optional<OtherSolver> other_;
  std::optional<Estimator> estimator_;
  std::vector<double> angles_;  ///< of the laws that the page has, rad
  double laws_at_ = 0;          ///< time from which the laws may be sent again, s

  std::vector<Snapshot> block_;
  std::vector<float> other_force_;
  std::vector<std::byte> frame_;
  Json messages_;
  bool any_message_ = false;
};

}  // namespace punctura::live
