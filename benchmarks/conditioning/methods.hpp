// The compared methods. The chosen one is the core's LineFit; the others exist only here.
#pragma once

#include <algorithm>
#include <memory>
#include <numbers>
#include <vector>

#include "punctura/signal/conditioning.hpp"
#include "rig.hpp"

namespace bench {

/// Applies the same scalar filter to each axis.
template <typename F>
struct EachAxis {
  F axis[3];
  explicit EachAxis(const F& f) : axis{f, f, f} {}
  Vector3d operator()(const Vector3d& x) { return {axis[0](x[0]), axis[1](x[1]), axis[2](x[2])}; }
};

/// Play (hysteresis): the output moves only when the input pushes it. `half`: half of the width.
struct Hysteresis {
  double half, y = NAN;
  double operator()(double x) { return y = std::isnan(y) ? x : std::clamp(y, x - half, x + half); }
};

/// Play with a ball instead of three intervals: hysteresis along the motion.
struct Ball {
  double radius;
  Vector3d y = Vector3d::Constant(NAN);
  Vector3d operator()(const Vector3d& x) {
    if (std::isnan(y[0])) y = x;
    const Vector3d away = x - y;
    if (away.norm() > radius) y += away * (1 - radius / away.norm());
    return y;
  }
};

/// Steady-state Kalman filter of a constant velocity: beta = alpha^2 / (2 - alpha) (Benedict and Bordner 1962).
struct AlphaBeta {
  double alpha, y = NAN, v = 0;
  double operator()(double x) {
    if (std::isnan(y)) y = x;
    const double residual = x - (y + v);
    y += v + alpha * residual;
    v += alpha * alpha / (2 - alpha) * residual;
    return y;
  }
};

/// The 1 euro filter, a low-pass whose cutoff rises with speed (Casiez, Roussel, Vogel 2012).
struct OneEuro {
  double rest_hz, hz_per_speed, speed_hz, y = NAN, x_prev = 0, speed = 0;
  static double gain(double hz) { return 1 - std::exp(-2 * std::numbers::pi * hz * T); }
  double operator()(double x) {
    if (std::isnan(y)) y = x_prev = x;
    speed += gain(speed_hz) * ((x - x_prev) / T - speed);
    x_prev = x;
    return y += gain(rest_hz + hz_per_speed * std::abs(speed)) * (x - y);
  }
};

/// The last samples, newest first. Missing earlier samples equal the first one.
struct History {
  std::vector<double> samples;
  explicit History(std::size_t n) : samples(n, NAN) {}
  void put(double x) {
    if (std::isnan(samples[0])) std::fill(samples.begin(), samples.end(), x);
    std::rotate(samples.begin(), samples.end() - 1, samples.end());
    samples[0] = x;
  }
  double operator[](std::size_t i) const { return samples[i]; }
  std::size_t size() const { return samples.size(); }
};

/// First-order adaptive windowing, end fit (Janabi-Sharifi, Hayward, Chen 2000): the longest window in which all
/// samples are within `tolerance` of the line through its end points. Returns the number of intervals.
inline std::size_t end_fit(const History& x, double tolerance) {
  std::size_t longest = 1;
  for (std::size_t n = 2; n < x.size(); ++n) {
    const double slope = (x[n] - x[0]) / static_cast<double>(n);
    for (std::size_t i = 1; i < n; ++i)
      if (std::abs(x[0] + slope * static_cast<double>(i) - x[i]) > tolerance * 1.0001) return longest;
    longest = n;
  }
  return longest;
}

/// Integrates that velocity to a position and corrects it towards the samples by the share `pull` per tick.
struct EndFitVelocity {
  History history;
  double tolerance, pull, y = NAN;
  double operator()(double x) {
    history.put(x);
    if (std::isnan(y)) y = x;
    const std::size_t n = end_fit(history, tolerance);
    y += (x - history[n]) / static_cast<double>(n);
    return y += pull * (x - y);
  }
};

/// End point of the least-squares line over the last n samples, relative to the newest sample.
inline double line_end(const History& x, std::size_t n) {
  double sum = 0, moment = 0;
  for (std::size_t i = 0; i < n; ++i) {
    sum += x[i] - x[0];
    moment += static_cast<double>(i) * (x[i] - x[0]);
  }
  const auto m = static_cast<double>(n);
  const double middle = (m - 1) / 2, slope = (moment - middle * sum) * 12 / (m * (m * m - 1));
  return sum / m - middle * slope;
}

/// End point of the least-squares line over the window of the end fit ("best fit"), as a position.
struct BestFitPosition {
  History history;
  double tolerance;
  double operator()(double x) {
    history.put(x);
    return x + line_end(history, end_fit(history, tolerance) + 1);
  }
};

/// End point of a least-squares line over a window of fixed length.
struct FixedLine {
  History history;
  double operator()(double x) {
    history.put(x);
    return x + line_end(history, history.size());
  }
};

/// Holds while the last samples stay within one count; otherwise tracks with their least-squares velocity.
struct HoldAndTrack {
  History history;
  double half, pull, y = NAN;
  double operator()(double x) {
    history.put(x);
    if (std::isnan(y)) y = x;
    const auto n = static_cast<double>(history.size());
    double moment = 0;
    for (std::size_t i = 0; i < history.size(); ++i)
      moment += ((n - 1) / 2 - static_cast<double>(i)) * (history[i] - x);
    const double slope = moment * 12 / (n * (n * n - 1));
    const bool moves =
        std::abs(slope) > 1.501 * count * n / (n * n - 1);  // more than any signal within one count can give
    if (moves) y += slope;
    const double residual = moves ? x - y : x - y - std::clamp(x - y, -half, half);
    y += pull * residual;
    return y = std::clamp(y, x - count, x + count);
  }
};

/// Wraps any filter with step(). Copies of the Filter share its state.
template <typename F, typename... Arguments>
Filter stateful(Arguments... arguments) {
  return [filter = std::make_shared<F>(arguments...)](const Vector3d& x) -> Vector3d { return filter->step(x); };
}

inline Filter low_pass(double hz) { return stateful<punctura::LowPass<double, Vector3d>>(hz, T); }

/// The conditioning of the core.
inline Filter core(punctura::Conditioning conditioning) {
  return stateful<punctura::PositionConditioner<double>>(conditioning, 300.0, count, T);
}

inline Filter chain(Filter first, Filter second) {
  return [first = std::move(first), second = std::move(second)](const Vector3d& x) { return second(first(x)); };
}

template <typename F>
Method before_low_pass(std::string name, std::string note, F filter) {
  return {std::move(name), std::move(note), [filter] { return chain(filter, low_pass(300)); }};
}

inline std::vector<Method> methods() {
  using punctura::Conditioning;
  return {
      {"none", "the encoder's positions as they come", [] { return low_pass(0); }},
      {"low_pass", "K06: first order, 300 Hz. In the core", [] { return core(Conditioning::low_pass); }},
      {"low_pass_40", "first order, 40 Hz", [] { return low_pass(40); }},
      before_low_pass("hysteresis", "one count wide, each axis, then 300 Hz", EachAxis(Hysteresis{count / 2})),
      before_low_pass("hysteresis_2", "two counts wide, each axis, then 300 Hz", EachAxis(Hysteresis{count})),
      before_low_pass("ball", "hysteresis of two counts along the motion, then 300 Hz", Ball{count}),
      before_low_pass("hold_track", "held within a count, else tracked (25 samples), then 300 Hz",
                      EachAxis(HoldAndTrack{History(25), count, 0.15})),
      before_low_pass("one_euro", "cutoff 50 Hz at rest, 300 Hz at 10 mm/s, then 300 Hz",
                      EachAxis(OneEuro{50, 25e3, 5})),
      before_low_pass("alpha_beta", "alpha 0.2, then 300 Hz", EachAxis(AlphaBeta{0.2})),
      before_low_pass("line_15ms", "a least-squares line over 15 ms, always, its end, then 300 Hz",
                      EachAxis(FixedLine{History(25)})),
      before_low_pass("foaw_velocity", "end fit within a count, 24 intervals, summed up, pull 0.1, then 300 Hz",
                      EachAxis(EndFitVelocity{History(25), count, 0.1})),
      before_low_pass("foaw_position", "best fit within a count, 24 intervals, its end, then 300 Hz",
                      EachAxis(BestFitPosition{History(25), count})),
      {"line_fit",
       "a line over 15 ms or less, extrapolated by the lag of 200 Hz, then 200 Hz, then a play of 0.4 counts. In the "
       "core",
       [] { return core(Conditioning::line_fit); }},
  };
}

}  // namespace bench
