// Desired motions of a hand: repeated strokes, a recorded motion, a target that a user moves, a velocity that a program
// sets.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include "punctura/lab/plant/hand.hpp"
#include "punctura/lab/plant/noise.hpp"

namespace punctura {

/// Repeated strokes from `start` to `end` and back. Each is a MinimumJerk, with a rest at both ends. Depth and duration
/// vary from stroke to stroke, as with a person.
struct Strokes {
  Vector3d start, end;     ///< m
  std::size_t count = 3;   ///< number of strokes, each to `end` and back
  double duration = 1.5;   ///< s, one way
  double rest = 0.6;       ///< s at each end, and before the first stroke
  double variation = 0.1;  ///< relative standard deviation of depth and duration; variations are clamped to 3 of them
};

/// A minimum-jerk movement (Flash and Hogan 1985) between two points, and the rest behind it.
template <typename Scalar, typename Vector = Vector3<Scalar>>
struct MinimumJerk {
  Scalar begin, duration;  ///< s
  Vector from, to;         ///< m

  /// The desired motion at a time (s), not before `begin`.
  BasicDesired<Scalar> at(const Scalar& time) const noexcept {
    using namespace lane;
    const Scalar u = (time - begin) / duration;
    const auto arrived = u >= 1;
    if (all(arrived)) return {to, {}};
    const Scalar path = u * u * u * (10 + u * (-15 + 6 * u));
    const Scalar rate = 30 * u * u * (1 - u) * (1 - u) / duration;
    const Vector way = to - from;
    if (!any(arrived)) return {from + path * way, rate * way};
    return {select(arrived, to, Vector(from + path * way)), select(arrived, Vector(), Vector(rate * way))};
  }
};

class StrokesMotion {
 public:
  StrokesMotion(const Strokes& strokes, std::uint64_t seed) : rest_(strokes.rest) {
    Noise noise(seed);
    const auto vary = [&] { return 1 + strokes.variation * std::clamp(noise.normal(), -3.0, 3.0); };
    Vector3d from = strokes.start;
    double time = rest_;
    for (std::size_t i = 0; i < strokes.count; ++i) {
      const Vector3d depth = strokes.start + vary() * (strokes.end - strokes.start);
      for (const Vector3d& to : {depth, strokes.start}) {
        segments_.push_back({time, std::max(1e-3, strokes.duration * vary()), from, to});
        time += segments_.back().duration + rest_;
        from = to;
      }
    }
    duration_ = time;
    home_.from = home_.to = strokes.start;
  }

  double duration() const noexcept { return duration_; }  ///< s

  /// The desired motion at a time (s, from 0). Fast if it is near the time of the last call.
  Desired at(double time) noexcept { return segment(time).at(time); }
  /// The movement at a time (s, from 0), with the rest behind it. Fast if it is near the time of the last call.
  const MinimumJerk<double>& segment(double time) noexcept {
    while (next_ > 0 && time < segments_[next_ - 1].begin) --next_;
    while (next_ < segments_.size() && time >= segments_[next_].begin) ++next_;
    return next_ == 0 ? home_ : segments_[next_ - 1];
  }

  /// When the movement after the last one of segment() begins, s.
  double next_begin() const noexcept {
    return next_ < segments_.size() ? segments_[next_].begin : std::numeric_limits<double>::infinity();
  }

  static void archive(auto& self, auto& state) { state.index(self.next_, self.segments_.size() + 1); }
  void describe(auto& parameters) const {
    parameters.fields(duration_, home_.to);
    for (const auto& s : segments_) parameters.fields(s.begin, s.duration, s.from, s.to);
  }

 private:
  double rest_, duration_ = 0;
  std::size_t next_ = 0;
  MinimumJerk<double> home_{-std::numeric_limits<double>::infinity(), 1, {}, {}};  // the rest before the first stroke
  std::vector<MinimumJerk<double>> segments_;
};

/// A motion from samples: linear between the samples, at rest before the first and after the last.
class RecordedMotion {
 public:
  /// time: s, ascending, at least one. position: m, as many as times.
  RecordedMotion(std::vector<double> time, std::vector<Vector3d> position)
      : time_(std::move(time)), position_(std::move(position)) {}

  double duration() const noexcept { return time_.back() - time_.front(); }  ///< s

  /// The desired motion at a time (s, from the first sample). Fast if it is near the time of the last call.
  Desired at(double time) noexcept {
    const double t = time_.front() + time;
    while (next_ > 0 && t < time_[next_ - 1]) --next_;
    while (next_ < time_.size() && t >= time_[next_]) ++next_;
    if (next_ == 0 || next_ == time_.size()) return {position_[next_ == 0 ? 0 : next_ - 1], Vector3d::Zero()};
    const double span = time_[next_] - time_[next_ - 1];
    const Vector3d step = position_[next_] - position_[next_ - 1];
    return {position_[next_ - 1] + (t - time_[next_ - 1]) / span * step, step / span};
  }

  const std::vector<double>& times() const noexcept { return time_; }            ///< s
  const std::vector<Vector3d>& positions() const noexcept { return position_; }  ///< m

  static void archive(auto& self, auto& state) { state.index(self.next_, self.time_.size() + 1); }
  void describe(auto& parameters) const {
    for (std::size_t i = 0; i < time_.size(); ++i) parameters.fields(time_[i], position_[i]);
  }

 private:
  std::vector<double> time_;
  std::vector<Vector3d> position_;
  std::size_t next_ = 0;
};

/// A target that a user moves in steps of any size, for example with a mouse. The hand follows it smoothly, through two
/// first-order lags of `lag` (s) each.
class Target {
 public:
  explicit Target(const Vector3d& position, double lag = 0.02) noexcept
      : lag_(lag), target_(position), first_(position), second_(position) {}

  void move_to(const Vector3d& position) noexcept { target_ = position; }
  const Vector3d& position() const noexcept { return target_; }

  /// The desired motion at a time (s). Times must not decrease from call to call.
  Desired at(double time) noexcept {
    const double gain = 1 - std::exp(-std::max(0.0, time - time_) / lag_);
    time_ = time;
    first_ += gain * (target_ - first_);
    second_ += gain * (first_ - second_);
    return {second_, (first_ - second_) / lag_};
  }

  static void archive(auto& self, auto& state) { state.fields(self.time_, self.target_, self.first_, self.second_); }
  void describe(auto& parameters) const { parameters.fields(lag_); }

 private:
  double lag_, time_ = 0;
  Vector3d target_, first_, second_;
};

/// A motion with a velocity that a program sets, for example a policy that learns. It starts at rest.
class Steered {
 public:
  explicit Steered(const Vector3d& position) noexcept : position_(position) {}

  /// velocity: m/s, from the next call of at() on.
  void steer(const Vector3d& velocity) noexcept { velocity_ = velocity; }

  /// The desired motion at a time (s). Times must not decrease from call to call.
  Desired at(double time) noexcept {
    position_ += std::max(0.0, time - time_) * velocity_;
    time_ = time;
    return {position_, velocity_};
  }

  static void archive(auto& self, auto& state) { state.fields(self.time_, self.position_, self.velocity_); }
  void describe(auto&) const {}

 private:
  double time_ = 0;
  Vector3d position_, velocity_ = Vector3d::Zero();
};

}  // namespace punctura
