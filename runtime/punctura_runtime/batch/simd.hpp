// A vector of doubles that the model can compute with, as model/lane.hpp requires.
#pragma once

#include <cstddef>

#include "punctura/proxy/solver.hpp"

namespace punctura::batch {

/// One truth value for each lane. It does not convert to bool.
template <typename Isa>
class SimdMask {
 public:
  using Native = typename Isa::Mask;

  SimdMask() noexcept : SimdMask(false) {}
  explicit SimdMask(bool b) noexcept : m_(Isa::truth(b)) {}
  static SimdMask from(const Native& m) noexcept {
    SimdMask mask;
    mask.m_ = m;
    return mask;
  }

  const Native& native() const noexcept { return m_; }
  /// Bit i is the value of lane i.
  unsigned bits() const noexcept { return Isa::bits(m_); }

  friend SimdMask operator&&(const SimdMask& a, const SimdMask& b) noexcept { return from(Isa::both(a.m_, b.m_)); }
  friend SimdMask operator||(const SimdMask& a, const SimdMask& b) noexcept { return from(Isa::either(a.m_, b.m_)); }
  friend SimdMask operator!(const SimdMask& a) noexcept { return from(Isa::invert(a.m_)); }
  friend bool any(const SimdMask& a) noexcept { return a.bits() != 0; }
  friend bool all(const SimdMask& a) noexcept { return a.bits() == (1u << Isa::lanes) - 1; }

 private:
  Native m_;
};

/// A vector of doubles. Each lane gets the bits of the same computation with one double.
template <typename Isa>
class Simd {
 public:
  using value_type = double;
  using Mask = SimdMask<Isa>;
  using Native = typename Isa::Vector;
  static constexpr std::size_t lanes = Isa::lanes;

  Simd() noexcept : Simd(0.0) {}
  Simd(double x) noexcept : v_(Isa::all(x)) {}
  static Simd from(const Native& v) noexcept {
    Simd simd;
    simd.v_ = v;
    return simd;
  }
  static Simd load(const double* from_here) noexcept { return from(Isa::load(from_here)); }
  void store(double* to) const noexcept { Isa::store(to, v_); }

  friend Simd operator+(const Simd& a, const Simd& b) noexcept { return from(Isa::add(a.v_, b.v_)); }
  friend Simd operator-(const Simd& a, const Simd& b) noexcept { return from(Isa::subtract(a.v_, b.v_)); }
  friend Simd operator*(const Simd& a, const Simd& b) noexcept { return from(Isa::multiply(a.v_, b.v_)); }
  friend Simd operator/(const Simd& a, const Simd& b) noexcept { return from(Isa::divide(a.v_, b.v_)); }
  friend Simd operator-(const Simd& a) noexcept { return from(Isa::negate(a.v_)); }
  friend Mask operator<(const Simd& a, const Simd& b) noexcept { return Mask::from(Isa::less(a.v_, b.v_)); }
  friend Mask operator>(const Simd& a, const Simd& b) noexcept { return b < a; }
  friend Mask operator<=(const Simd& a, const Simd& b) noexcept { return Mask::from(Isa::less_equal(a.v_, b.v_)); }
  friend Mask operator>=(const Simd& a, const Simd& b) noexcept { return b <= a; }
  friend Mask operator==(const Simd& a, const Simd& b) noexcept { return Mask::from(Isa::equal(a.v_, b.v_)); }
  friend Simd select(const Mask& m, const Simd& a, const Simd& b) noexcept {
    return from(Isa::select(m.native(), a.v_, b.v_));
  }
  friend Simd min(const Simd& a, const Simd& b) noexcept { return from(Isa::smaller(a.v_, b.v_)); }
  friend Simd max(const Simd& a, const Simd& b) noexcept { return from(Isa::larger(a.v_, b.v_)); }
  friend Simd sqrt(const Simd& a) noexcept { return from(Isa::root(a.v_)); }
  friend Simd floor(const Simd& a) noexcept { return from(Isa::round_down(a.v_)); }

 private:
  Native v_;
};

/// An instruction set, for vectors that have phases.
template <typename Isa>
struct WithPhases : Isa {};

/// Stands for the phases of the lanes, which a batch on a line does not compute.
struct NoPhase {
  NoPhase() = default;
  NoPhase(Phase) noexcept {}
};
template <typename Isa>
NoPhase select(const SimdMask<Isa>&, NoPhase, NoPhase) noexcept {
  return {};
}

}  // namespace punctura::batch

namespace punctura {

template <typename Isa>
struct PhaseFor<batch::Simd<Isa>> {
  using type = batch::NoPhase;
};
template <typename Isa>
struct PhaseFor<batch::Simd<batch::WithPhases<Isa>>> {
  using type = Phases<batch::Simd<batch::WithPhases<Isa>>>;
};

}  // namespace punctura
