// A position estimate against encoder noise: the end of a straight line through the last samples.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "punctura/model/storage.hpp"

namespace punctura {

/// Fits a straight line to the last samples by least squares. step() returns the end of the line.
///
/// If the samples do not lie on the line within `tolerance`, the window is halved until they do: 17, 9, 5 and 3
/// samples for 10 ms at 1600 Hz, then only the newest sample. So the estimate follows a steady motion without lag and
/// does not smear a sudden motion. All memory is allocated at construction.
///
/// The longest window that the noise permits is the first-order adaptive window of Janabi-Sharifi, Hayward and Chen
/// (2000). They compute the slope of the line, a velocity. LineFit computes the end of the line, a position.
///
/// Each window has an odd number n of samples. An encoder that toggles in each tick then moves the end of the line by
/// 1/n of a step. With an even n it would be 3/n.
template <typename Scalar, typename Storage = HeapStorage>
class LineFit {
 public:
  static constexpr std::size_t most_samples = 129;         ///< it bounds the time of a tick
  static constexpr Scalar steps_of_tolerance = Scalar(2);  ///< one step of noise, and one step of quantization

  /// encoder_step: the resolution of the encoder, m; 0 is an ideal sensor, and its samples pass unchanged. window:
  /// length of the longest window, s. period: s. lead: step() extrapolates the line by this many ticks, to compensate
  /// the lag of a filter behind it.
  LineFit(Scalar encoder_step, Scalar window, Scalar period, Scalar lead = 0)
      : tolerance_(steps_of_tolerance * encoder_step), lead_(lead), size_(samples(window, period)), ring_(2 * size_) {}

  void reset() noexcept {
    started_ = false;
    newest_ = 0;
    std::fill(ring_.begin(), ring_.end(), Scalar{});
  }

  /// Takes over the samples of another fit, but keeps its own tolerance and lead. `previous` loses its samples.
  ///
  /// If the windows differ in size, it starts without samples.
  void resume(LineFit& previous) noexcept {
    if (previous.size_ != size_) return reset();
    ring_.swap(previous.ring_);
    newest_ = previous.newest_;
    started_ = std::exchange(previous.started_, false);
  }

  static void archive(auto& self, auto& state) {
    state.flag(self.started_);
    state.index(self.newest_, self.size_);
    for (auto& sample : self.ring_) state.numbers(sample);
  }
  void describe(auto& parameters) const {
    parameters.numbers(tolerance_, lead_);
    parameters.index(size_, most_samples + 1);
  }

  /// One tick. x: measured position, m. Returns the estimated position, m.
  Scalar step(Scalar x) noexcept {
    if (tolerance_ == 0) return x;
    if (!started_) std::fill(ring_.begin(), ring_.end(), x);
    started_ = true;
    // Each sample is written twice. So the last size_ samples are always contiguous, the newest first.
    newest_ = newest_ == 0 ? size_ - 1 : newest_ - 1;
    ring_[newest_] = ring_[newest_ + size_] = x;
    for (std::size_t n = size_; n >= 3; n = (n / 2) | 1) {
      const Line line = fit(n);
      if (holds(line, n)) return x + (line.end - lead_ * line.slope);
    }
    return x;
  }

  std::size_t size() const noexcept { return size_; }  ///< samples in the longest window

 private:
  struct Line {
    Scalar end, slope;  ///< m from the newest sample; m per tick into the past
  };

  static std::size_t samples(Scalar window, Scalar period) noexcept {
    const Scalar half = std::round(window / (2 * period));
    return 2 * static_cast<std::size_t>(std::clamp(half, Scalar(1), Scalar(most_samples / 2))) + 1;
  }

  /// A sample relative to the newest one, m. So a position far from the origin loses no digits.
  Scalar sample(std::size_t age) const noexcept { return ring_[newest_ + age] - ring_[newest_]; }

  Line fit(std::size_t n) const noexcept {
    Scalar sum = 0, moment = 0;
    for (std::size_t i = 1; i < n; ++i) {
      const Scalar z = sample(i);
      sum += z;
      moment += static_cast<Scalar>(i) * z;
    }
    const auto count = static_cast<Scalar>(n);
    const Scalar middle = (count - 1) / 2;
    const Scalar slope = (moment - middle * sum) * 12 / (count * (count * count - 1));
    return {sum / count - middle * slope, slope};
  }

  bool holds(const Line& line, std::size_t n) const noexcept {
    for (std::size_t i = 0; i < n; ++i)
      if (!(std::abs(line.end + static_cast<Scalar>(i) * line.slope - sample(i)) <= tolerance_)) return false;
    return true;
  }

  Scalar tolerance_, lead_;
  std::size_t size_, newest_ = 0;
  bool started_ = false;
  typename Storage::template Samples<Scalar> ring_;
};

}  // namespace punctura
