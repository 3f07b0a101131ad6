// A position estimate against encoder noise: the end of a straight line through the last samples.
#pragma once

#include <algorithm>
#include <cstddef>
#include <utility>

#include "punctura/model/lane.hpp"
#include "punctura/model/storage.hpp"

namespace punctura {

/// Fits a straight line to the last samples by least squares. step() returns the end of the line.
///
/// A line holds if its samples scatter around it as an encoder does, and if its end is within `tolerance` of the newest
/// sample. If it does not hold, the window is halved until it does: 25, 13, 7 and 3 samples for 15 ms at 1600 Hz, then
/// only the newest sample. So the estimate follows a steady motion without lag and does not smear a sudden motion. All
/// memory is allocated at construction.
///
/// The longest window that the noise permits is the first-order adaptive window of Janabi-Sharifi, Hayward and Chen
/// (2000). They compute the slope of the line, a velocity. LineFit computes the end of the line, a position.
///
/// Each window has an odd number n of samples. An encoder that toggles in each tick then moves the end of the line by
/// 1/n of a step. With an even n it would be 3/n.
///
/// Running sums give the line of the longest window, so that the time of a tick does not grow with the window. They are
/// computed afresh once a window: so no rounding errors collect, and a position far from the origin loses no digits.
template <typename Scalar, typename Storage = HeapStorage>
class LineFit {
 public:
  static constexpr std::size_t most_samples = 129;         ///< it bounds the time of a tick
  static constexpr Scalar steps_of_tolerance = Scalar(2);  ///< one step of noise, and one step of quantization
  /// The largest scatter of the samples around a line, rms, in steps. Noise of one step in both directions has at most
  /// 1 step, and a sudden motion soon has more.
  static constexpr Scalar steps_of_scatter = Scalar(1.1);

  /// Sums over the samples z of a window, relative to an origin: of z, of z times its age, of z squared.
  struct Sums {
    Scalar zero{}, one{}, square{};
  };
  using Ring = typename Storage::template Samples<Scalar>;
  /// The samples. A fit with the state of another one of the same size goes on from them, with its own tolerance and
  /// lead.
  struct State {
    bool started = false;
    std::size_t newest = 0;
    Scalar origin{};  ///< of the sums, m
    Sums sums{};
    Ring ring{};
  };
  State state{};

  /// encoder_step: the resolution of the encoder, m; 0 is an ideal sensor, and its samples pass unchanged. window:
  /// length of the longest window, s. period: s. lead: step() extrapolates the line by this many ticks, to compensate
  /// the lag of a filter behind it.
  constexpr LineFit(Scalar encoder_step, Scalar window, Scalar period, Scalar lead = 0)
      : tolerance_(steps_of_tolerance * encoder_step),
        most_square_(steps_of_scatter * encoder_step * (steps_of_scatter * encoder_step)),
        lead_(lead),
        size_(samples(window, period)),
        whole_(size_) {
    state.ring = Ring(2 * size_, Scalar());
  }

  constexpr void reset() noexcept {
    state = {false, 0, 0, {}, std::move(state.ring)};
    std::fill(state.ring.begin(), state.ring.end(), Scalar{});
  }

  static void archive(auto& self, auto& state) {
    state.flag(self.state.started);
    state.index(self.state.newest, self.size_);
    auto& sums = self.state.sums;
    state.fields(self.state.origin, sums.zero, sums.one, sums.square, self.state.ring);
  }
  void describe(auto& parameters) const { parameters.fields(tolerance_, most_square_, lead_, size_); }

  /// One tick. x: measured position, m. Returns the estimated position, m.
  constexpr Scalar step(Scalar x) noexcept {
    if (tolerance_ == 0) return x;
    auto& [started, newest, origin, sums, ring] = state;
    if (!started) {
      std::fill(ring.begin(), ring.end(), x);
      origin = x;
      sums = {};
      started = true;
    }
    // Each sample is written twice. So the last size_ samples are always contiguous, the newest first.
    newest = newest == 0 ? size_ - 1 : newest - 1;
    const Scalar oldest = ring[newest] - origin;
    ring[newest] = ring[newest + size_] = x;
    if (newest == 0) {
      origin = x;
      sums = sums_of(size_, x);
    } else {
      const Scalar now = x - origin;
      sums.one += sums.zero - static_cast<Scalar>(size_) * oldest;
      sums.zero += now - oldest;
      sums.square += now * now - oldest * oldest;
    }
    if (const Line line = whole_.line(sums, x - origin); holds(line, whole_)) return end_of(line, x);
    for (std::size_t n = shorter(size_); n >= 3 && n < size_; n = shorter(n)) {
      const Window window(n);
      if (const Line line = window.line(sums_of(n, x), 0); holds(line, window)) return end_of(line, x);
    }
    return x;
  }

  constexpr std::size_t size() const noexcept { return size_; }  ///< samples in the longest window

  /// The size of the window that is tried after one of n samples; 1 is the newest sample alone.
  static constexpr std::size_t shorter(std::size_t n) noexcept { return (n / 2) | 1; }

  /// The weight of the sample of this age (ticks) in the result while the window of n samples, 3 or more, holds.
  constexpr Scalar weight(std::size_t n, std::size_t age) const noexcept {
    return end_of(Window(n).line({1, static_cast<Scalar>(age), 1}, 0), 0);
  }

 private:
  struct Line {
    Scalar end, slope;  ///< m from the newest sample; m per tick into the past
    Scalar squares;     ///< of the distances of the samples from the line, m^2
  };
  /// The constants of a window of n samples.
  struct Window {
    Scalar n, inv_n, middle, inv_moment;  // moment: of the ages around their mean

    constexpr explicit Window(std::size_t samples) noexcept
        : n(static_cast<Scalar>(samples)), inv_n(1 / n), middle((n - 1) / 2), inv_moment(12 / (n * (n * n - 1))) {}

    /// newest: the newest sample, relative to the origin of the sums.
    constexpr Line line(const Sums& sums, Scalar newest) const noexcept {
      const Scalar mean = sums.zero * inv_n, tilt = sums.one - middle * sums.zero, slope = tilt * inv_moment;
      return {mean - middle * slope - newest, slope, sums.square - sums.zero * mean - slope * tilt};
    }
  };

  static constexpr std::size_t samples(Scalar window, Scalar period) noexcept {
    const Scalar half = std::clamp(window / (2 * period), Scalar(1), Scalar(most_samples / 2));
    return 2 * static_cast<std::size_t>(half + Scalar(0.5)) + 1;
  }

  /// The sums over the last n samples.
  constexpr Sums sums_of(std::size_t n, Scalar origin) const noexcept {
    Sums sums;
    for (std::size_t age = 0; age < n; ++age) {
      const Scalar z = state.ring[state.newest + age] - origin;
      sums.zero += z;
      sums.one += static_cast<Scalar>(age) * z;
      sums.square += z * z;
    }
    return sums;
  }

  constexpr bool holds(const Line& line, const Window& window) const noexcept {
    return line.squares <= window.n * most_square_ && lane::abs(line.end) <= tolerance_;
  }
  constexpr Scalar end_of(const Line& line, Scalar x) const noexcept { return x + (line.end - lead_ * line.slope); }

  Scalar tolerance_;
  Scalar most_square_;  // m^2, of the mean square of the samples' distances from a line
  Scalar lead_;
  std::size_t size_;
  Window whole_;
};

}  // namespace punctura
