// The needle's direction from its motion, for devices that report no orientation (K06, after (41)).
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>

#include "punctura/model/storage.hpp"
#include "punctura/model/vector3.hpp"

namespace punctura {

/// The unit direction of the tip's displacement in a recent window. It is zero as long as the tip has not moved.
///
/// The window is the last 10 ms, or the last 0.2 mm of the path if that began earlier.
///
/// All samples of the last 10 ms are stored. A slow hand can need minutes for 0.2 mm. Therefore only one point of the
/// path is stored for each 1/64 of 0.2 mm. The memory is fixed, and the window of the path is 0.2 mm to 0.2031 mm
/// long. All memory is allocated at construction.
template <typename Scalar, typename Storage = HeapStorage>
class EntryDirection {
 public:
  using Vector = Vector3<Scalar>;
  static constexpr Scalar window = Scalar(0.010);      ///< s
  static constexpr Scalar path_window = Scalar(2e-4);  ///< m

  constexpr explicit EntryDirection(Scalar period)
      : recent_(static_cast<std::size_t>(window / period + Scalar(0.5)) + 1, Vector()) {}

  constexpr void reset() noexcept {
    std::fill(recent_.begin(), recent_.end(), Vector());
    std::fill(path_.begin(), path_.end(), Mark());
    head_ = tail_ = 0;
    ticks_ = 0;
    length_ = 0;
    last_ = {};
  }

  static void archive(auto& self, auto& state) {
    state.fields(self.ticks_);
    state.index(self.head_, self.path_.size());
    state.index(self.tail_, self.path_.size());
    state.fields(self.length_, self.last_, self.recent_, self.path_);
  }
  void describe(auto& parameters) const { parameters.index(recent_.size(), 0); }

  /// One tick. p: conditioned position of the tip, m. Returns the direction of the motion.
  constexpr Vector step(const Vector& p) noexcept {
    if (ticks_ == 0) {
      length_ = 0;
      head_ = tail_ = 0;
      path_[0] = {p, 0, 0};
    } else {
      if (length_ > 1) shorten();
      length_ += (p - last_).norm();
      if (length_ - path_[head_].length >= path_window / marks) {
        head_ = next(head_);
        path_[head_] = {p, length_, ticks_};
      }
      while (tail_ != head_ && length_ - path_[next(tail_)].length >= path_window) tail_ = next(tail_);
    }
    last_ = p;

    const std::size_t span = recent_.size() - 1;
    const std::size_t slot = static_cast<std::size_t>(ticks_ % recent_.size());
    const bool full = ticks_ >= span;
    recent_[slot] = p;
    const std::uint64_t time_tick = full ? ticks_ - span : 0;
    const Vector& time_point = full ? recent_[(slot + 1) % recent_.size()] : recent_[0];
    const Vector& from = path_[tail_].tick < time_tick ? path_[tail_].point : time_point;
    ++ticks_;

    const Vector moved = p - from;
    const Scalar distance = moved.norm();
    return distance > 0 ? Vector(moved / distance) : Vector(Vector::Zero());
  }

 private:
  struct Mark {
    Vector point;
    Scalar length{};       ///< length of the path up to this point, m
    std::uint64_t tick{};  ///< the tick in which the tip was here
    static void archive(auto& self, auto& state) { state.fields(self.point, self.length, self.tick); }
  };
  static constexpr std::size_t marks = 64;

  /// Sets the length of the path to 0 at the present point. A long path would lose digits, above all in float.
  constexpr void shorten() noexcept {
    for (Mark& mark : path_) mark.length -= length_;
    length_ = 0;
  }

  constexpr std::size_t next(std::size_t i) const noexcept { return i + 1 < path_.size() ? i + 1 : 0; }

  typename Storage::template Samples<Vector> recent_;
  std::array<Mark, marks + 2> path_{};
  std::size_t head_ = 0, tail_ = 0;
  std::uint64_t ticks_ = 0;
  Scalar length_{};
  Vector last_ = Vector::Zero();
};

}  // namespace punctura
