// Two vectors of an instruction set as one, for one that only counts.
#pragma once

#include <cstddef>

namespace punctura::bench_batch {

template <typename Isa>
struct Twice {
  static constexpr std::size_t lanes = 2 * Isa::lanes;
  struct Vector {
    typename Isa::Vector a, b;
  };
  struct Mask {
    typename Isa::Mask a, b;
  };

  static Vector all(double x) noexcept { return {Isa::all(x), Isa::all(x)}; }
  static Vector load(const double* from) noexcept { return {Isa::load(from), Isa::load(from + Isa::lanes)}; }
  static void store(double* to, const Vector& v) noexcept {
    Isa::store(to, v.a);
    Isa::store(to + Isa::lanes, v.b);
  }
  static Vector add(const Vector& x, const Vector& y) noexcept { return {Isa::add(x.a, y.a), Isa::add(x.b, y.b)}; }
  static Vector subtract(const Vector& x, const Vector& y) noexcept {
    return {Isa::subtract(x.a, y.a), Isa::subtract(x.b, y.b)};
  }
  static Vector multiply(const Vector& x, const Vector& y) noexcept {
    return {Isa::multiply(x.a, y.a), Isa::multiply(x.b, y.b)};
  }
  static Vector divide(const Vector& x, const Vector& y) noexcept {
    return {Isa::divide(x.a, y.a), Isa::divide(x.b, y.b)};
  }
  static Vector negate(const Vector& x) noexcept { return {Isa::negate(x.a), Isa::negate(x.b)}; }
  static Vector root(const Vector& x) noexcept { return {Isa::root(x.a), Isa::root(x.b)}; }
  static Vector round_down(const Vector& x) noexcept { return {Isa::round_down(x.a), Isa::round_down(x.b)}; }
  static Vector smaller(const Vector& x, const Vector& y) noexcept {
    return {Isa::smaller(x.a, y.a), Isa::smaller(x.b, y.b)};
  }
  static Vector larger(const Vector& x, const Vector& y) noexcept {
    return {Isa::larger(x.a, y.a), Isa::larger(x.b, y.b)};
  }
  static Mask less(const Vector& x, const Vector& y) noexcept { return {Isa::less(x.a, y.a), Isa::less(x.b, y.b)}; }
  static Mask less_equal(const Vector& x, const Vector& y) noexcept {
    return {Isa::less_equal(x.a, y.a), Isa::less_equal(x.b, y.b)};
  }
  static Mask equal(const Vector& x, const Vector& y) noexcept { return {Isa::equal(x.a, y.a), Isa::equal(x.b, y.b)}; }
  static Mask truth(bool b) noexcept { return {Isa::truth(b), Isa::truth(b)}; }
  static Mask both(const Mask& x, const Mask& y) noexcept { return {Isa::both(x.a, y.a), Isa::both(x.b, y.b)}; }
  static Mask either(const Mask& x, const Mask& y) noexcept { return {Isa::either(x.a, y.a), Isa::either(x.b, y.b)}; }
  static Mask invert(const Mask& x) noexcept { return {Isa::invert(x.a), Isa::invert(x.b)}; }
  static Vector select(const Mask& m, const Vector& x, const Vector& y) noexcept {
    return {Isa::select(m.a, x.a, y.a), Isa::select(m.b, x.b, y.b)};
  }
  static unsigned bits(const Mask& m) noexcept { return Isa::bits(m.a) | Isa::bits(m.b) << Isa::lanes; }
};

}  // namespace punctura::bench_batch
