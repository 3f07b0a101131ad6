#include "punctura/model/thick_law.hpp"

#include <doctest/doctest.h>

#include "../support/cases.hpp"
#include "../support/random_law.hpp"
#include "punctura/model/law.hpp"
#include "punctura/model/thin_law.hpp"

using namespace punctura;
using namespace punctura::test;

static_assert(ObliqueLaw<ThickLaw> && ObliqueLaw<ThickLawF> && Law<ThinLaw> && Law<ThinLawF>);

namespace {

/// The six printed cases of K06 (18), with slip E3 corrected. With A = A_O and sign = +1 it is (19).
double printed(double q, double A, double sign, const LawConstants<double>& k, double H, double U) {
  const double X = k.X, Q = k.Q, F = k.F;
  if (q < 0) return 0;
  if (q <= std::min(U, X)) return sign * A * q * (q + 2 * Q) / (2 * H);
  if (U <= q && q <= X) return sign * A * U * (2 * q - U + 2 * Q) / (2 * H);
  if (X <= q && q <= U) return sign * (F * (q - X) / H + A * X * (X + 2 * Q) / (2 * H));
  if (q <= X + U) return sign * (F * (q - X) / H + A * (U + X - q) * (q - U + X + 2 * Q) / (2 * H));
  return sign * F * U / H;
}

double largest(const ThickLaw& law) {
  const auto& k = law.constants();
  const double cos_beta = law.thickness() / law.path_length();
  return std::max(k.A_I * (k.X + k.Q), k.F) / cos_beta;
}

}  // namespace

TEST_CASE("the pieces are the six printed cases of (18) and (19)") {
  Noise noise(2);
  double worst = 0;
  for (int i = 0; i < cases(20000); ++i) {
    const LawCase c = random_law(noise, 1e-6);
    const ThickLaw law(c.needle, c.membrane, c.obliquity);
    const auto& k = law.constants();
    const double H = law.thickness(), U = law.path_length();
    REQUIRE(U == doctest::Approx(H / std::cos(c.obliquity)));
    for (int j = 0; j < 20; ++j) {
      const double q = between(noise, -0.1, 1.2) * (k.X + U);
      const auto band = law.band(q);
      worst = std::max(worst, std::abs(band.lower - printed(q, k.A_I, -1, k, H, U)) / largest(law));
      worst = std::max(worst, std::abs(band.upper - printed(q, k.A_O, +1, k, H, U)) / largest(law));
    }
  }
  MESSAGE("largest difference, relative to the law's largest force: " << worst);
  CHECK(worst < 1e-10);  // for H = 1 um, the printed form loses digits by cancellation
}

TEST_CASE("the lower edge is <= 0 and <= the upper edge, and both edges are 0 in front") {
  Noise noise(3);
  for (int i = 0; i < cases(20000); ++i) {
    const LawCase c = random_law(noise);
    const ThickLaw law(c.needle, c.membrane, c.obliquity);
    const double end = law.constants().X + law.path_length();
    for (int j = 0; j < 10; ++j) {
      const double q = between(noise, -0.2, 1.2) * end;
      const auto band = law.band(q);
      REQUIRE(band.lower <= 0);
      REQUIRE(band.lower <= band.upper);
      if (q > 1e-6 * end) REQUIRE(band.lower < band.upper);
      if (q < 0) REQUIRE((band.lower == 0 && band.upper == 0));
    }
  }
}

TEST_CASE("the edges of the thick law are continuous at the breaks") {
  Noise noise(4);
  for (int i = 0; i < cases(5000); ++i) {
    const LawCase c = random_law(noise);
    const ThickLaw law(c.needle, c.membrane, c.obliquity);
    for (double at : law.pieces().breaks) {
      const double near = 1e-13 * std::max(at, 1e-3);
      const auto before = law.band(at - near), behind = law.band(at + near);
      REQUIRE(std::abs(before.lower - behind.lower) < 1e-6 * largest(law));
      REQUIRE(std::abs(before.upper - behind.upper) < 1e-6 * largest(law));
    }
  }
}

TEST_CASE("with thickness 0 the thick law is the thin law times 1 / cos(beta)") {
  const ThinLaw thin(paper_needle, paper_membrane(0));
  for (double beta : {0.0, 0.5, 1.2}) {
    const ThickLaw law(paper_needle, paper_membrane(0), beta);
    for (double q : {-1e-3, 0.0, 1e-3, thin.constants().X, 3.8e-3, 1.0}) {
      CHECK(law.band(q).lower == doctest::Approx(thin.band(q).lower / std::cos(beta)));
      CHECK(law.band(q).upper == doctest::Approx(thin.band(q).upper / std::cos(beta)));
    }
  }
}

TEST_CASE("float and double agree within the precision of float") {
  Noise noise(5);
  double worst = 0;
  for (int i = 0; i < cases(5000); ++i) {
    const LawCase c = random_law(noise, 1e-4);
    const auto f = [](double x) { return static_cast<float>(x); };
    const ThickLawF single(
        {f(c.needle.diameter), f(c.needle.tip_angle)},
        {f(c.membrane.stiffness), f(c.membrane.precompression), f(c.membrane.friction), f(c.membrane.thickness)},
        f(c.obliquity));
    // The double law has the rounded parameters, so that only the arithmetic is compared.
    const ThickLaw law(
        {f(c.needle.diameter), f(c.needle.tip_angle)},
        {f(c.membrane.stiffness), f(c.membrane.precompression), f(c.membrane.friction), f(c.membrane.thickness)},
        f(c.obliquity));
    // mu tan(theta) near 1 divides by a small difference. This error comes from the parameters, not from the
    // arithmetic.
    if (c.membrane.friction * std::tan(c.needle.tip_angle) > 0.9) continue;
    const float q = f(between(noise, 0, 1.2) * (law.constants().X + law.path_length()));
    worst = std::max(worst, std::abs(static_cast<double>(single.band(q).lower) - law.band(q).lower) / largest(law));
    worst = std::max(worst, std::abs(static_cast<double>(single.band(q).upper) - law.band(q).upper) / largest(law));
  }
  MESSAGE("largest difference, relative: " << worst);
  CHECK(worst < 2e-4);
}
