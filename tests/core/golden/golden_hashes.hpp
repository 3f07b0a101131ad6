// One hash for all forces of a golden scene. The test compares it, and record_forces.cpp writes it.
#pragma once

#include <bit>

#include "golden_scenes.hpp"
#include "punctura/model/thick_law.hpp"
#include "punctura/model/thin_law.hpp"
#include "punctura/proxy/proxy_1d.hpp"
#include "punctura/scene/build.hpp"

namespace punctura::test {

/// FNV-1a over the bits of all forces.
class Hash {
 public:
  void add(double force) noexcept { mix(std::bit_cast<std::uint64_t>(force), 8); }
  void add(float force) noexcept { mix(std::bit_cast<std::uint32_t>(force), 4); }
  std::uint64_t value() const noexcept { return value_; }

 private:
  void mix(std::uint64_t bits, int bytes) noexcept {
    for (int i = 0; i < bytes; ++i) value_ = (value_ ^ (bits >> (8 * i) & 0xff)) * 0x100000001b3u;
  }
  std::uint64_t value_ = 0xcbf29ce484222325u;
};

/// The first wall alone, on the axis of the needle, with its thin and its thick law.
template <typename Scalar>
std::uint64_t forces_1d(const GoldenCase& c, Solver solver) {
  const auto to = [](double x) { return static_cast<Scalar>(x); };
  const BasicNeedle<Scalar> needle{to(c.scene.needle.diameter), to(c.scene.needle.tip_angle)};
  const Membrane& m = c.scene.membranes[0].membrane;
  const BasicMembrane<Scalar> wall{to(m.stiffness), to(m.precompression), to(m.friction), to(m.thickness)};
  const BasicCoupling<Scalar> coupling{to(c.scene.coupling.stiffness), to(c.scene.coupling.damping)};
  const Scalar period = to(1 / c.scene.servo.rate);
  Proxy1d thin(BasicThinLaw<Scalar>(needle, wall), coupling, period, solver);
  Proxy1d thick(BasicThickLaw<Scalar>(needle, wall), coupling, period, solver);
  Hash hash;
  for (const Vector3d& p : c.positions) {
    hash.add(thin.step(to(-p.y())));
    hash.add(thick.step(to(-p.y())));
  }
  return hash.value();
}

/// All walls, in space.
template <typename Scalar>
std::uint64_t forces_3d(const GoldenCase& c, Solver solver) {
  Scene scene = c.scene;
  scene.servo.solver = solver;
  auto insertion = build_insertion<Scalar>(scene);
  const Vector3<Scalar> axis = c.axis.template cast<Scalar>();
  Hash hash;
  for (const Vector3d& p : c.positions)
    for (Scalar f : insertion.step(p.template cast<Scalar>(), axis)) hash.add(f);
  return hash.value();
}

using GoldenHashes = std::array<std::uint64_t, 8>;
inline constexpr const char* golden_names[] = {"1-D paper double", "1-D paper float",  "1-D exact double",
                                               "1-D exact float",  "3-D paper double", "3-D paper float",
                                               "3-D exact double", "3-D exact float"};

inline GoldenHashes golden_hashes(std::size_t k) {
  const GoldenCase c = golden_case(k);
  return {forces_1d<double>(c, Solver::paper), forces_1d<float>(c, Solver::paper),  forces_1d<double>(c, Solver::exact),
          forces_1d<float>(c, Solver::exact),  forces_3d<double>(c, Solver::paper), forces_3d<float>(c, Solver::paper),
          forces_3d<double>(c, Solver::exact), forces_3d<float>(c, Solver::exact)};
}

}  // namespace punctura::test
