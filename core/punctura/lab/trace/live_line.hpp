// A straight line through the force of the last stretch, with its uncertainty, sample by sample.
#pragma once

#include <algorithm>
#include <cmath>

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
    state.numbers(self.level_, self.slope_, self.p00_, self.p01_, self.p11_, self.m00_, self.m01_, self.m11_,
                  self.squares_, self.weight_, self.samples_);
    state.require(self.p00_ >= 0 && self.p11_ >= 0 && self.squares_ >= 0 && self.weight_ >= 0);
  }
  void describe(auto& parameters) const { parameters.numbers(memory_, noise_); }

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

}  // namespace punctura
