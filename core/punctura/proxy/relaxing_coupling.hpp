// A virtual coupling that relaxes: K06's coupling and, beside it, one or two Maxwell branches.
#pragma once

#include <array>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <span>

#include "punctura/proxy/coupling.hpp"

namespace punctura {

/// A Maxwell branch: a spring in series with a damper. While the needle rests, its force decays by exp(-t / tau).
template <typename Scalar>
struct BasicMaxwellBranch {
  Scalar stiffness = Scalar(not_given);      ///< K_m, N/m: of the spring. 0 removes the branch
  Scalar time_constant = Scalar(not_given);  ///< tau, s: damping over stiffness

  bool operator==(const BasicMaxwellBranch&) const = default;
};
using MaxwellBranch = BasicMaxwellBranch<double>;

inline constexpr std::size_t max_branches = 2;

/// K06's coupling (21) with Maxwell branches beside it, sampled with the period T (s): a standard linear solid.
///
/// The force of a branch obeys f_m' = K_m e' - f_m / tau. If e changes at a constant rate within a tick, its exact
/// solution is f_m(k) = a f_m(k-1) + k_m (e(k) - e(k-1)), with a = exp(-T / tau) and k_m = K_m (1 - a) tau / T. So
/// the force of the coupling stays linear in e(k): f* gets the sum of a f_m(k-1), and g the sum of k_m.
///
/// Without branches, each function gives the bits of SampledCoupling.
template <typename Scalar_>
class RelaxingCoupling {
 public:
  using Scalar = Scalar_;
  /// The force of each branch, N.
  template <typename Vector>
  struct Memory {
    std::array<Vector, max_branches> force{};

    static void archive(auto& self, auto& state) { state.fields(self.force); }
    template <typename M>
      requires(!std::same_as<M, bool>)
    friend constexpr Memory select(const M& mask, const Memory& a, const Memory& b) noexcept {
      Memory chosen;
      for (std::size_t i = 0; i < max_branches; ++i) chosen.force[i] = select(mask, a.force[i], b.force[i]);
      return chosen;
    }
  };
  struct Branch {
    Scalar a{1}, k{};  ///< what a tick leaves of the force; k_m, N/m
  };
  /// What the ticks compute with. free_share: without force, e is this fraction of e_prev.
  struct Constants {
    Scalar K, g, inv_g, free_share;
    std::array<Branch, max_branches> branches{};
    std::size_t count = 0;
  };

  Scalar g;      ///< K + B/T + sum of k_m, N/m: force per displacement of the proxy within one tick
  Scalar inv_g;  ///< m/N

  /// branches: at most max_branches are used. Their time constants must be greater than 0.
  constexpr RelaxingCoupling(const BasicCoupling<Scalar>& coupling,
                             std::span<const BasicMaxwellBranch<Scalar>> branches, Scalar period) noexcept
      : g(0), inv_g(0), spring_(coupling, period) {
    using namespace lane;
    Scalar sum = 0;
    for (const auto& branch : branches) {
      if (count_ == max_branches || branch.stiffness == 0) continue;
      const Scalar x = period / branch.time_constant;
      branches_[count_] = {exp(-x), branch.stiffness * (-expm1(-x) / x)};
      sum += branches_[count_++].k;
    }
    g = spring_.g + sum;
    inv_g = count_ == 0 ? spring_.inv_g : 1 / g;
    free_share_ = count_ == 0 ? spring_.B_over_D : (spring_.B / spring_.T + sum) / g;
  }
  constexpr RelaxingCoupling(const BasicCoupling<Scalar>& coupling, Scalar period) noexcept
      : RelaxingCoupling(coupling, {}, period) {}
  /// For lanes: each lane has the constants of a coupling for one number.
  constexpr explicit RelaxingCoupling(const Constants& c) noexcept
      : g(c.g),
        inv_g(c.inv_g),
        spring_({c.K, Scalar(0)}, Scalar(1)),
        branches_(c.branches),
        count_(c.count),
        free_share_(c.free_share) {}
  constexpr Constants constants() const noexcept { return {spring_.K, g, inv_g, free_share_, branches_, count_}; }

  constexpr Scalar period() const noexcept { return spring_.period(); }  ///< s
  void describe(auto& parameters) const {
    spring_.describe(parameters);
    for (const Branch& branch : branches_) parameters.fields(branch.a, branch.k);
  }

  /// f*, N: the force that holds the proxy still. K06 (27), (38), and what is left of the branches' forces.
  /// Inlined as the tick in space is: see settle_inside().
  template <typename Vector>
  [[gnu::always_inline]] constexpr Vector holding_force(const Vector& p, const Vector& p_prev, const Vector& e_prev,
                                                        const Memory<Vector>& memory) const noexcept {
    Vector f = -g * (p - p_prev) + spring_.K * e_prev;
    for (std::size_t i = 0; i < count_; ++i) f = f + branches_[i].a * memory.force[i];
    return f;
  }

  /// e after a tick without force, m. K06 (25) with f = 0.
  template <typename Vector>
  constexpr Vector free_offset(const Vector& e_prev, const Memory<Vector>& memory) const noexcept {
    Vector e = free_share_ * e_prev;
    for (std::size_t i = 0; i < count_; ++i) e = e - inv_g * (branches_[i].a * memory.force[i]);
    return e;
  }

  /// Ends a tick: the branches' new forces.
  template <typename Vector>
  constexpr void advance(Memory<Vector>& memory, const Vector& e, const Vector& e_prev) const noexcept {
    for (std::size_t i = 0; i < count_; ++i)
      memory.force[i] = without_denormals(Vector(branches_[i].a * memory.force[i] + branches_[i].k * (e - e_prev)));
  }

  /// Sets the forces of branches that this coupling does not have to 0, after memory was taken from another coupling.
  template <typename Vector>
  constexpr void clear_unused(Memory<Vector>& memory) const noexcept {
    for (std::size_t i = count_; i < max_branches; ++i) memory.force[i] = {};
  }

  constexpr std::size_t branches() const noexcept { return count_; }  ///< the number of branches with a stiffness

 private:
  SampledCoupling<Scalar> spring_;
  std::array<Branch, max_branches> branches_{};
  std::size_t count_ = 0;
  Scalar free_share_ = 0;  // without force, e is this fraction of e_prev
};

}  // namespace punctura
