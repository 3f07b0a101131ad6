// Position conditioning between encoders and model: the paper's low-pass, or a line fit against encoder noise.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <utility>

#include "punctura/model/field.hpp"
#include "punctura/model/omni.hpp"
#include "punctura/model/vector3.hpp"
#include "punctura/signal/line_fit.hpp"
#include "punctura/signal/low_pass.hpp"

namespace punctura {

/// How measured positions are conditioned for the model. docs/conditioning.md compares these methods with others.
enum class Conditioning : std::uint8_t {
  low_pass,  ///< a first-order low-pass, as in K06 section 4
  line_fit,  ///< for real devices: LineFit on each axis, a low-pass whose lag the fit compensates, and a small play
};
template <>
inline constexpr std::array<std::string_view, 2> words_of<Conditioning>{"low_pass", "line_fit"};

/// How strongly the line fit smooths: as the encoder of the Omni needs it, and less for finer encoders.
///
/// The window scales with the square root of the encoder step. The force noise then stays about constant, and a
/// device with a fine encoder does not get a lag that it does not need.
template <typename Scalar>
struct Smoothing {
  Scalar window;     ///< the window of LineFit, s
  Scalar cutoff_hz;  ///< the cutoff of the low-pass behind LineFit; 0 is off, for an ideal sensor
  /// Half the play behind the low-pass, m. What is left of the noise moves nothing within it. A motion lags by it.
  Scalar half_play;

  static constexpr Smoothing of(Scalar encoder_step) noexcept {
    const Scalar share = lane::sqrt(std::min(Scalar(1), encoder_step / Scalar(Omni::encoder_step)));
    return {Scalar(0.015) * share, share > 0 ? Scalar(200) / share : Scalar(0), Scalar(0.2) * encoder_step};
  }
};

/// Computes the position for the model (m) from the measured position (m).
///
/// It treats each axis separately. An axis that rests then stays quiet while another axis moves.
template <typename Scalar, typename Storage = HeapStorage>
class PositionConditioner {
 public:
  using Vector = Vector3<Scalar>;
  using Line = LineFit<Scalar, Storage>;

  /// low_pass_hz: for Conditioning::low_pass; 0 is off. encoder_step: for Conditioning::line_fit, m; 0 is off.
  /// period: s.
  constexpr PositionConditioner(Conditioning conditioning, Scalar low_pass_hz, Scalar encoder_step, Scalar period)
      : PositionConditioner(conditioning == Conditioning::line_fit, low_pass_hz, encoder_step, period,
                            Smoothing<Scalar>::of(encoder_step)) {}

  constexpr void reset() noexcept {
    for (auto& line : lines_) line.reset();
    low_pass_.state = {};
    played_ = {};
  }

  /// Takes over the samples of another conditioner of the same period. `previous` loses its history. A line with a
  /// window of another size starts without samples.
  constexpr void resume(PositionConditioner& previous) noexcept {
    for (std::size_t i = 0; i < 3; ++i)
      if (lines_[i].size() == previous.lines_[i].size())
        std::swap(lines_[i].state, previous.lines_[i].state);
      else
        lines_[i].reset();
    low_pass_.state = previous.low_pass_.state;
    played_ = previous.fits_ ? previous.played_ : previous.low_pass_.state.y;
  }

  static void archive(auto& self, auto& state) {
    if (self.fits_) state.fields(self.lines_, self.played_);
    state.fields(self.low_pass_);
  }
  void describe(auto& parameters) const {
    parameters.fields(fits_, half_play_);
    lines_[0].describe(parameters);
    low_pass_.describe(parameters);
  }

  constexpr bool started() const noexcept { return low_pass_.started(); }
  constexpr Scalar low_pass_gain() const noexcept { return low_pass_.gain(); }  ///< of a sample, 0 to 1
  /// Of one axis; null: no line is fitted.
  constexpr const Line* line() const noexcept { return fits_ ? &lines_[0] : nullptr; }

  /// Inlined without the line fit: in front of few membranes, the call is a part of the tick that one sees.
  [[gnu::always_inline]] constexpr Vector step(const Vector& measured) noexcept {
    return fits_ ? fitted(measured) : low_pass_.step(measured);
  }

 private:
  [[gnu::noinline]] constexpr Vector fitted(const Vector& measured) noexcept {
    const bool first = !low_pass_.started();
    const Vector y =
        low_pass_.step({lines_[0].step(measured[0]), lines_[1].step(measured[1]), lines_[2].step(measured[2])});
    for (std::size_t i = 0; i < 3; ++i)
      played_[i] = first ? y[i] : std::min(std::max(played_[i], y[i] - half_play_), y[i] + half_play_);
    return played_;
  }
  constexpr PositionConditioner(bool fits, Scalar low_pass_hz, Scalar encoder_step, Scalar period,
                                const Smoothing<Scalar>& as)
      : fits_(fits),
        half_play_(as.half_play),
        low_pass_(fits ? as.cutoff_hz : low_pass_hz, period),
        lines_{{{encoder_step, as.window, period, low_pass_.lag()},
                {encoder_step, as.window, period, low_pass_.lag()},
                {encoder_step, as.window, period, low_pass_.lag()}}} {}

  bool fits_;
  Scalar half_play_;
  LowPass<Scalar, Vector> low_pass_;
  std::array<Line, 3> lines_;
  Vector played_{};  // the position behind the play, m
};

}  // namespace punctura
