// The reference in space: K06 (41) written by hand, on plain numbers.
#pragma once

#include <vector>

#include "fused_1d.hpp"
#include "punctura/scene/scene.hpp"

namespace bench {

template <typename Scalar>
struct Vec {
  Scalar x{}, y{}, z{};

  Scalar operator[](int i) const noexcept { return i == 0 ? x : i == 1 ? y : z; }
  friend Vec operator+(const Vec& a, const Vec& b) noexcept { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
  friend Vec operator-(const Vec& a, const Vec& b) noexcept { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
  friend Vec operator*(Scalar s, const Vec& a) noexcept { return {s * a.x, s * a.y, s * a.z}; }
  friend Scalar dot(const Vec& a, const Vec& b) noexcept { return a.x * b.x + a.y * b.y + a.z * b.z; }
};

/// One membrane, entered only from the front and steeply. Cases that the measured motions do not have are left out.
template <typename Scalar>
class Fused3d {
 public:
  Fused3d(const punctura::LawConstants<Scalar>& law, Scalar H, const Vec<Scalar>& point,
          const Vec<Scalar>& inward_normal, const punctura::BasicCoupling<Scalar>& coupling, Scalar T)
      : constants_(law),
        law_(law, H, 1),
        H_(H),
        a_(point),
        n_(inward_normal),
        K_(coupling.stiffness),
        g_(coupling.stiffness + coupling.damping / T),
        inv_g_(1 / g_),
        B_over_D_(coupling.damping / (coupling.stiffness * T + coupling.damping)) {}

  void reset() noexcept {
    started_ = false;
    e_ = f_ = {};
    inside_ = false;
  }

  /// Forced inline: otherwise GCC 12 passes vectors through memory, which costs 5 ns.
  [[gnu::always_inline]] Vec<Scalar> step(const Vec<Scalar>& p, const Vec<Scalar>& axis) noexcept {
    if (!started_) p_ = p;
    started_ = true;
    const Vec<Scalar> rest = B_over_D_ * e_;
    const Scalar height = dot(n_, p + rest + inv_g_ * f_ - a_);  // of q*, K06 (40)
    if (height <= 0) {
      inside_ = false;
      f_ = {};
    } else {
      if (!inside_) enter(axis);
      const Vec<Scalar> f_star = K_ * e_ - g_ * (p - p_);  // K06 (38)
      const Scalar along = dot(b_, f_star);
      f_ = f_star + (law_.clamp(height * inv_cos_, along) - along) * b_;  // K06 (39)
    }
    e_ = rest + inv_g_ * f_;
    p_ = p;
    return f_;
  }

 private:
  void enter(const Vec<Scalar>& axis) noexcept {
    const Scalar cos_beta = dot(n_, axis);
    inside_ = true;
    b_ = axis;
    inv_cos_ = 1 / cos_beta;
    law_ = FusedLaw<Scalar>(constants_, H_, cos_beta);
  }

  punctura::LawConstants<Scalar> constants_;
  FusedLaw<Scalar> law_;
  Scalar H_;
  Vec<Scalar> a_, n_, b_;
  Scalar inv_cos_{1}, K_, g_, inv_g_, B_over_D_;
  Vec<Scalar> p_, e_, f_;
  bool started_ = false, inside_ = false;
};

/// The sum over several membranes, in scene order.
template <typename Scalar>
class FusedInsertion {
 public:
  explicit FusedInsertion(const punctura::Scene& scene) {
    const auto to = [](double x) { return static_cast<Scalar>(x); };
    for (const auto& placed : scene.membranes) {
      const auto& m = placed.membrane;
      const auto &a = placed.point, &n = placed.inward_normal;
      const punctura::LawConstants<Scalar> law(
          {to(scene.needle.diameter), to(scene.needle.tip_angle)},
          {to(m.stiffness), to(m.precompression), to(m.friction), to(m.thickness)});
      membranes_.emplace_back(law, to(m.thickness), Vec<Scalar>{to(a[0]), to(a[1]), to(a[2])},
                              Vec<Scalar>{to(n[0]), to(n[1]), to(n[2])},
                              punctura::BasicCoupling<Scalar>{to(scene.coupling.stiffness), to(scene.coupling.damping)},
                              to(1 / scene.servo.rate));
    }
  }

  void reset() noexcept {
    for (auto& membrane : membranes_) membrane.reset();
  }

  Vec<Scalar> step(const Vec<Scalar>& p, const Vec<Scalar>& axis) noexcept {
    Vec<Scalar> sum;
    for (auto& membrane : membranes_) sum = sum + membrane.step(p, axis);
    return sum;
  }

 private:
  std::vector<Fused3d<Scalar>> membranes_;
};

}  // namespace bench
