// Punctura in CHAI3D: a haptic effect that gives the force of a needle that goes through membranes.
//
//   auto* tissue = new chai3d::cMesh();                            // any object; the scene is in its frame
//   tissue->addEffect(new cPuncturaEffect(tissue, scene_text));    // the text of a scene file
//
// The header needs CHAI3D 3.3 and links with libpunctura (docs/c-abi.md).
#pragma once

#include <time.h>

#include <chrono>
#include <cmath>
#include <functional>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>

#include "effects/CGenericEffect.h"
#include "math/CVector3d.h"
#include "punctura.h"

/// The force of a scene on a tool of one point, such as cToolCursor. Other points get no force.
///
/// CHAI3D calls an effect as often as the haptic loop runs. The effect makes all ticks of the scene's rate that are due
/// by its clock, on a straight line from the last position. After a gap of more than 50 ms the needle starts anew.
///
/// The force is the model's. The device's own limits are CHAI3D's: set them there.
class cPuncturaEffect : public chai3d::cGenericEffect {
 public:
  using Clock = std::function<double()>;  ///< seconds

  /// scene: the text of a scene file. Its frame is that of `parent`. metres_per_unit: of the CHAI3D world.
  /// Throws std::invalid_argument with all problems of the scene, or if metres_per_unit is not positive.
  cPuncturaEffect(chai3d::cGenericObject* parent, const std::string& scene, double metres_per_unit = 1,
                  Clock clock = steady_seconds)
      : cGenericEffect(parent), metres_per_unit_(metres_per_unit), clock_(std::move(clock)) {
    punctura_scene* made = nullptr;
    if (!(metres_per_unit > 0) || std::isinf(metres_per_unit))
      throw std::invalid_argument("metres_per_unit must be positive: 1 for a world in metres, 0.001 for millimetres");
    if (!punctura_check_abi()) throw std::invalid_argument("punctura.h and libpunctura do not fit together");
    if (punctura_scene_from_toml(scene.data(), scene.size(), &made) != PUNCTURA_OK)
      throw std::invalid_argument(punctura_last_error());
    const std::unique_ptr<punctura_scene, void (*)(punctura_scene*)> owner(made, punctura_scene_free);
    punctura_insertion* insertion = nullptr;
    if (punctura_scene_get(made, "servo.rate", &rate_) != PUNCTURA_OK ||
        punctura_insertion_new(made, &insertion) != PUNCTURA_OK)
      throw std::invalid_argument(punctura_last_error());
    insertion_.reset(insertion);
  }

  /// The direction in which the needle points, in the frame of the parent. Call it in each haptic cycle for a device
  /// with orientation. Without it, the needle points along -y, straight down in the frame of a scene; a scene with
  /// direction = "motion" does not read it.
  void setAxis(const chai3d::cVector3d& axis) { axis_ = axis; }

  /// The ticks so far, for tests and displays.
  unsigned long long ticks() const { return ticks_; }
  /// The insertion, to read membranes and state between two haptic cycles.
  punctura_insertion* insertion() { return insertion_.get(); }

  /// Called by CHAI3D. a_toolPos: in the frame of the parent.
  bool computeForce(const chai3d::cVector3d& a_toolPos, const chai3d::cVector3d&, const unsigned int& a_toolID,
                    chai3d::cVector3d& a_reactionForce) override {
    a_reactionForce.zero();
    if (!m_enabled) return false;
    if (!has_tool_) tool_ = a_toolID, has_tool_ = true;
    if (a_toolID != tool_) return false;
    const double position[3] = {a_toolPos.x() * metres_per_unit_, a_toolPos.y() * metres_per_unit_,
                                a_toolPos.z() * metres_per_unit_};
    advance(clock_(), position);
    a_reactionForce.set(force_[0], force_[1], force_[2]);
    return force_[0] != 0 || force_[1] != 0 || force_[2] != 0;
  }

 private:
  /// Goes on while the computer sleeps: the force must not go on after it as if nothing had happened.
  static double steady_seconds() {
#if defined(CLOCK_BOOTTIME) || defined(__APPLE__)
#ifdef CLOCK_BOOTTIME
    constexpr clockid_t clock = CLOCK_BOOTTIME;  // std::chrono::steady_clock stands still on Linux and macOS
#else
    constexpr clockid_t clock = CLOCK_MONOTONIC;
#endif
    timespec now{};
    if (clock_gettime(clock, &now) == 0)
      return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
#endif
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
  }

  void advance(double now, const double (&position)[3]) {
    constexpr double longest_gap = 0.05;
    if (!(now - time_ >= 0 && now - time_ <= longest_gap)) {
      punctura_insertion_reset(insertion_.get());
      start_ = now;
      ticks_in_run_ = 0;
      for (int k = 0; k < 3; ++k) last_[k] = position[k];
    }
    const double axis[3] = {axis_.x(), axis_.y(), axis_.z()};
    // A tick that is due within a thousandth of a period is made now.
    const auto due = static_cast<unsigned long long>(std::floor((now - start_) * rate_ + 1e-3)) + 1;
    const unsigned long long count = due > ticks_in_run_ ? due - ticks_in_run_ : 0;
    for (unsigned long long i = 1; i <= count; ++i) {
      const double share = static_cast<double>(i) / static_cast<double>(count);
      double at[3], force[3];
      for (int k = 0; k < 3; ++k) at[k] = i == count ? position[k] : last_[k] + (position[k] - last_[k]) * share;
      const bool good = punctura_insertion_step(insertion_.get(), at, axis, force) == PUNCTURA_OK;
      for (int k = 0; k < 3; ++k) force_[k] = good ? force[k] : 0;
    }
    ticks_in_run_ += count;
    ticks_ += count;
    time_ = now;
    for (int k = 0; k < 3; ++k) last_[k] = position[k];
  }

  struct Free {
    void operator()(punctura_insertion* insertion) const { punctura_insertion_free(insertion); }
  };
  std::unique_ptr<punctura_insertion, Free> insertion_;
  double metres_per_unit_, rate_ = 0;
  Clock clock_;
  chai3d::cVector3d axis_{0, -1, 0};
  unsigned int tool_ = 0;
  bool has_tool_ = false;
  double time_ = std::nan(""), start_ = 0;
  unsigned long long ticks_ = 0, ticks_in_run_ = 0;
  double last_[3] = {0, 0, 0}, force_[3] = {0, 0, 0};
};
