// For devices that report no orientation: the needle's direction from its motion (K06, after (41)).
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

#include "punctura/model/storage.hpp"
#include "punctura/model/vector3.hpp"

namespace punctura {

/// Unit direction of the tip's displacement over the last 10 ms, or over the last 0.2 mm of its path where that reaches
/// further back in time. Zero while the tip has not moved.
///
/// The 10 ms are kept sample by sample. Of the path, which may take a slow hand minutes, only one point in every 1/64 of
/// 0.2 mm is kept, so the memory is fixed and the window is 0.2 mm to 0.2031 mm long. All memory is taken at construction.
template <typename Scalar, typename Storage = HeapStorage>
class EntryDirection {
 public:
  using Vector = Vector3<Scalar>;
  static constexpr Scalar window = Scalar(0.010);      ///< s
  static constexpr Scalar path_window = Scalar(2e-4);  ///< m

  explicit EntryDirection(Scalar period) : recent_(static_cast<std::size_t>(std::lround(window / period)) + 1) {}

  void reset() noexcept {
    std::fill(recent_.begin(), recent_.end(), Vector());
    std::fill(path_.begin(), path_.end(), Mark());
    head_ = tail_ = 0;
    ticks_ = 0;
    length_ = 0;
    last_ = {};
  }

  /// Goes on with the history of another one of the same period, which loses it. Takes no memory.
  void resume(EntryDirection& previous) noexcept {
    if (previous.recent_.size() == recent_.size()) std::swap(*this, previous);
  }

  static void archive(auto& self, auto& state) {
    constexpr auto any = std::numeric_limits<std::uint64_t>::max();
    state.index(self.ticks_, any);
    state.index(self.head_, self.path_.size());
    state.index(self.tail_, self.path_.size());
    state.numbers(self.length_, self.last_);
    for (auto& point : self.recent_) state.numbers(point);
    for (auto& mark : self.path_) {
      state.numbers(mark.point, mark.length);
      state.index(mark.tick, any);
    }
  }
  void describe(auto& parameters) const { parameters.index(recent_.size(), 0); }

  /// One tick: p (m), the filtered tip, gives the direction in which it has come.
  Vector step(const Vector& p) noexcept {
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
    Scalar length{};       ///< of the path up to here, m
    std::uint64_t tick{};  ///< when
  };
  static constexpr std::size_t marks = 64;

  /// Counts the path from here on, so that its digits (float's above all) are not used up by a long session.
  void shorten() noexcept {
    for (Mark& mark : path_) mark.length -= length_;
    length_ = 0;
  }

  std::size_t next(std::size_t i) const noexcept { return i + 1 < path_.size() ? i + 1 : 0; }

  typename Storage::template Samples<Vector> recent_;
  std::array<Mark, marks + 2> path_{};
  std::size_t head_ = 0, tail_ = 0;
  std::uint64_t ticks_ = 0;
  Scalar length_{};
  Vector last_ = Vector::Zero();
};

}  // namespace punctura
