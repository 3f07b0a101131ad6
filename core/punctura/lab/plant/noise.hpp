// Random numbers that are the same on every machine for the same seed.
#pragma once

#include <cstdint>
#include <random>
#include <type_traits>

#include "punctura/lab/plant/unit_normal.hpp"
#include "punctura/model/vector3.hpp"

namespace punctura {

/// A random number generator. The C++ standard defines the numbers of std::mt19937_64, but not those of its
/// distributions, and not the bits of std::log and std::cos. Therefore the distributions are implemented here.
class Noise {
 public:
  explicit Noise(std::uint64_t seed) noexcept : seed_(seed), engine_(seed) {}

  /// Uniform in [0, 1), with 53 bits.
  double uniform() noexcept {
    ++drawn_;
    return static_cast<double>(engine_() >> 11) * 0x1p-53;
  }

  /// Normal with mean 0 and variance 1.
  double normal() noexcept {
    const double u = uniform(), v = uniform();
    return unit_normal(u, v);
  }

  /// Three numbers. They are drawn in the order z, y, x: the compiler chooses the order of a call's arguments.
  Vector3d uniform_vector() noexcept {
    const double z = uniform(), y = uniform(), x = uniform();
    return {x, y, z};
  }
  Vector3d normal_vector() noexcept {
    const double z = normal(), y = normal(), x = normal();
    return {x, y, z};
  }

  /// For save_state() and load_state() (state/archive.hpp). The state is the number of drawn numbers. Loading draws
  /// them again, so it takes longer after a long run.
  static void archive(auto& self, auto& state) {
    std::uint64_t drawn = self.drawn_;
    state.index(drawn, std::uint64_t{1} << 40);
    if constexpr (std::remove_reference_t<decltype(state)>::reading) {
      self = Noise(self.seed_);
      self.engine_.discard(drawn);
      self.drawn_ = drawn;
    }
  }
  void describe(auto& parameters) const { parameters.index(seed_, 0); }

 private:
  std::uint64_t seed_, drawn_ = 0;
  std::mt19937_64 engine_;
};

}  // namespace punctura
