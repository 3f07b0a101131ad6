// While a needle goes in: a line through the force of the last stretch, and punctures.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

namespace punctura {

/// Recursive least squares for force = level + slope (depth - present depth), with exponential forgetting over depth.
///
/// The uncertainty is that of independent noise of one size about the line. An old sample counts less, but its noise is
/// not larger: with weights w the covariance is P M P, P = (sum w x x^T)^-1, M = sum w^2 x x^T. A curved force adds to
/// the noise; the bias that it gives is not included.
class LiveLine {
 public:
  /// memory: length over which samples are forgotten, m. noise: smallest standard deviation of a sample, N.
  LiveLine(double memory, double noise) noexcept : memory_(memory), noise_(noise) {}

  void reset() noexcept { *this = LiveLine(memory_, noise_); }

  /// A sample of the force (N), `step` (m, 0 or more) behind the last one.
  void add(double step, double force) noexcept {
    const double keep =
        std::max(std::exp(-step / memory_), 1e-6);  // after a jump of the depth, too, numbers stay finite
    level_ = samples_ == 0 ? force : level_ + slope_ * step;
    p00_ = (p00_ + step * (2 * p01_ + step * p11_)) / keep;
    p01_ = (p01_ + step * p11_) / keep;
    p11_ /= keep;
    m11_ = keep * keep * (m11_ + step * (step * m00_ - 2 * m01_));
    m01_ = keep * keep * (m01_ - step * m00_);
    m00_ *= keep * keep;
    const double error = force - level_, total = p00_ + 1, gain0 = p00_ / total, gain1 = p01_ / total;
    if (samples_ >= 2) {  // two samples give the line; the others say how well it fits
      squares_ = keep * squares_ + error * error / (variance(p00_, p01_) + 1);
      weight_ = keep * weight_ + 1;
    }
    level_ += gain0 * error;
    slope_ += gain1 * error;
    p11_ -= gain1 * p01_;
    p01_ -= gain0 * p01_;
    p00_ -= gain0 * p00_;
    m00_ += 1;
    samples_ = std::min(samples_ + 1, 1e9);
  }

  bool ready() const noexcept { return weight_ >= 5; }  ///< whether the uncertainty is known
  double level() const noexcept { return level_; }      ///< force at the last sample, N
  double slope() const noexcept { return slope_; }      ///< N/m
  double level_error() const noexcept { return sigma() * std::sqrt(variance(p00_, p01_)); }  ///< standard deviation, N
  double slope_error() const noexcept { return sigma() * std::sqrt(variance(p01_, p11_)); }  ///< N/m
  double at(double ahead) const noexcept { return level_ + slope_ * ahead; }  ///< force `ahead` of the last sample, N

  static void archive(auto& self, auto& state) {
    state.fields(self.level_, self.slope_, self.p00_, self.p01_, self.p11_, self.m00_, self.m01_, self.m11_,
                 self.squares_, self.weight_, self.samples_);
    state.require(self.p00_ >= 0 && self.p11_ >= 0 && self.squares_ >= 0 && self.weight_ >= 0);
  }
  void describe(auto& parameters) const { parameters.fields(memory_, noise_); }

 private:
  double sigma() const noexcept { return std::max(noise_, weight_ > 0 ? std::sqrt(squares_ / weight_) : noise_); }

  /// a^T M a over the variance of a sample, for a row a of P.
  double variance(double a0, double a1) const noexcept {
    return std::max(0.0, a0 * (a0 * m00_ + 2 * a1 * m01_) + a1 * a1 * m11_);
  }

  double memory_, noise_;
  double level_ = 0, slope_ = 0;
  double p00_ = 1e4, p01_ = 0, p11_ = 1e12;  ///< P of a line that may be anything: (100)^2, and (1e6 / m)^2
  double m00_ = 0, m01_ = 0, m11_ = 0;       ///< M
  double squares_ = 0, weight_ = 0, samples_ = 0;
};

struct LivePunctureSettings {
  double noise = 4e-3, least_drop = 0.06, least_share = 0.08, least_speed = 3e-4, unloading = 2000;  ///< live_fields
  double limit = 10;  ///< of the cumulative sum, in standard deviations
};

/// A cumulative sum (Page 1954) of (greatest force - force) / noise - slack, with at most 4 a tick, so that a single
/// wrong tick is no puncture. The slack is half of the smallest drop, which is at least 8 standard deviations.
///
/// Two falls of the force are no punctures: when the needle draws back, the elastic unloading is added to the force
/// again; when it rests, the greatest force follows the force (relaxation).
class LivePuncture {
 public:
  explicit LivePuncture(const LivePunctureSettings& settings = {}) noexcept : settings_(settings) {}

  /// One tick. depth: m, growing inwards. force: N, against the insertion. Returns true in the tick in which a puncture
  /// is found.
  bool step(double depth, double force, double period) noexcept {
    if (!started_) {
      started_ = true;
      depth_ = deepest_ = depth;
      force_ = calm_ = greatest_ = least_ = force;
      return false;
    }
    const double share = -std::expm1(-period / smoothing);
    velocity_ += share * ((depth - depth_) / period - velocity_);
    const double jump = std::clamp(force - force_, -4 * noise(), 4 * noise());
    variance_ += -std::expm1(-period / noise_memory) * (jump * jump / 2 - variance_);
    depth_ = depth;
    force_ = force;
    calm_ += calming * (force - calm_);
    const bool deeper = depth > deepest_;
    deepest_ = std::max(deepest_, depth);

    if (falling_) return end_of_fall(force, deeper);
    const double unloaded = settings_.unloading * (deepest_ - depth), held = force + unloaded;
    if (velocity_ < settings_.least_speed) {
      sum_ = 0;
      if (velocity_ < 0 && deepest_ - depth > far_back) deepest_ = depth + far_back;  // a withdrawal, not a tremor
      greatest_ += share * (std::min(calm_, greatest_) - greatest_);
      return false;
    }
    greatest_ = std::max(greatest_, calm_);
    const double slack = std::max(4 * noise(), 0.5 * std::max(settings_.least_drop, settings_.least_share * greatest_));
    sum_ = std::max(0.0, sum_ + std::min(4.0, (greatest_ - held - slack) / noise()));
    if (sum_ < settings_.limit) return false;
    falling_ = true;
    least_ = low_ = calm_;
    low_at_ = depth;
    sum_ = 0;
    drop_ = greatest_ - force;
    return true;
  }

  bool falling() const noexcept { return falling_; }      ///< whether the drop is still going on
  double drop() const noexcept { return drop_; }          ///< drop of the last puncture so far, N; 0 before the first
  double calm_force() const noexcept { return calm_; }    ///< the force, smoothed over about four ticks, N
  double velocity() const noexcept { return velocity_; }  ///< smoothed, m/s
  double noise() const noexcept { return std::max(settings_.noise, std::sqrt(variance_)); }  ///< of a tick, N
  const LivePunctureSettings& settings() const noexcept { return settings_; }

  static void archive(auto& self, auto& state) {
    state.fields(self.started_, self.falling_, self.depth_, self.deepest_, self.velocity_, self.force_, self.calm_,
                 self.greatest_, self.least_, self.sum_, self.variance_, self.drop_, self.low_, self.low_at_);
    state.require(self.variance_ >= 0);
  }
  void describe(auto& parameters) const {
    parameters.fields(settings_.noise, settings_.least_drop, settings_.least_share, settings_.limit,
                      settings_.least_speed, settings_.unloading);
  }

 private:
  static constexpr double smoothing = 0.02;     ///< of the velocity, s
  static constexpr double calming = 0.25;       ///< of the force, share of a tick
  static constexpr double noise_memory = 0.25;  ///< s
  static constexpr double far_back = 2e-4;      ///< more than a tremor, m
  static constexpr double flat = 3e-4;          ///< way without a fall that ends a drop, m

  /// The drop ends when the needle draws back, when the force has risen again by a few standard deviations, or has not
  /// fallen over `flat`, as on the plateau behind a wall. After a rest or a tremor within a thick wall, the force comes
  /// back to where it was and falls on: only ticks deeper than before count, after a rest those deeper by `far_back`.
  bool end_of_fall(double force, bool deeper) noexcept {
    bool ends = deepest_ - depth_ > 2 * far_back;
    if (velocity_ < settings_.least_speed) {
      deepest_ = std::max(deepest_, depth_ + far_back);
    } else if (deeper) {
      drop_ = std::max(drop_, greatest_ - force);
      least_ = std::min(least_, calm_);
      if (calm_ < low_ - std::max(noise(), 0.1 * settings_.least_drop)) {
        low_ = calm_;
        low_at_ = depth_;
      }
      ends = calm_ > least_ + std::max(3 * noise(), 0.5 * settings_.least_drop) || depth_ - low_at_ > flat;
    }
    if (ends) {
      falling_ = false;
      greatest_ = calm_;
      deepest_ = depth_;
    }
    return false;
  }

  LivePunctureSettings settings_;
  bool started_ = false, falling_ = false;
  double depth_ = 0, deepest_ = 0, velocity_ = 0, force_ = 0, calm_ = 0;
  double greatest_ = 0, least_ = 0, sum_ = 0, variance_ = settings_.noise * settings_.noise, drop_ = 0;
  double low_ = 0, low_at_ = 0;  ///< the last new low of the calm force in a drop, N, and its depth, m
};

}  // namespace punctura
