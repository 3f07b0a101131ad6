// The other solver on the same samples, for display only. It is the C++ of python/punctura/studio/followers.py.
#pragma once

#include <array>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "punctura/scene/build.hpp"
#include "punctura/servo/snapshot.hpp"

namespace punctura::live {

/// It starts once the tip is outside every membrane, where both solvers agree. Its force is NaN before.
class OtherSolver {
 public:
  /// scene must have passed check().
  explicit OtherSolver(Scene scene) : insertion_(built(std::move(scene))) {}

  std::array<float, 3> step(const Snapshot& s) noexcept {
    const Vector3d position = to_vector(s.sample.position), axis = to_vector(s.sample.axis);
    const bool good = position.allFinite() && axis.allFinite() && s.fault == Fault::none;
    bool outside = true;
    for (std::size_t i = 0; i < s.membrane_count; ++i) outside = outside && s.membranes[i].phase == Phase::outside;
    if (good && outside && !begun_) {
      insertion_.reset();
      begun_ = true;
    }
    begun_ = begun_ && good;
    if (!begun_) return {nan, nan, nan};
    const Vector3d force = insertion_.step(position, axis.stableNormalized());
    return {static_cast<float>(force[0]), static_cast<float>(force[1]), static_cast<float>(force[2])};
  }

 private:
  static constexpr float nan = std::numeric_limits<float>::quiet_NaN();
  static BasicInsertion<double> built(Scene scene) {
    scene.servo.solver = scene.servo.solver == Solver::exact ? Solver::paper : Solver::exact;
    std::vector<Problem> none;
    return *try_build_insertion<double>(scene, none);
  }
  BasicInsertion<double> insertion_;
  bool begun_ = false;
};

}  // namespace punctura::live
