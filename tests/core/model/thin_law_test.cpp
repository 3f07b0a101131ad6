#include "punctura/model/thin_law.hpp"

#include <doctest/doctest.h>

#include "../support/random_law.hpp"

using namespace punctura;
using namespace punctura::test;

TEST_CASE("the constants of K06 section 4 have their reference values to 12 digits") {
  const auto c = ThinLaw(paper_needle, paper_membrane(0)).constants();
  const auto is = [](double value, double reference) { return std::abs(value / reference - 1) < 1e-12; };
  CHECK(is(c.X, 3.7558120442572873e-3));
  CHECK(is(c.A_I, 0.11757056589624991e3));
  CHECK(is(c.A_O, 0.019210953071314766e3));
  CHECK(is(c.Q, 2.5014342724910454e-3));
  CHECK(is(c.F, 0.41024));
  CHECK(c.A_I * (c.X + c.Q) == doctest::Approx(0.7357).epsilon(1e-4));
}

TEST_CASE("the thin law is zero in front, linear on the tip and constant on the shaft") {
  const ThinLaw law(paper_needle, paper_membrane(0));
  const auto& [X, A_I, A_O, Q, F] = law.constants();
  CHECK(law.band(-1e-9).lower == 0);
  CHECK(law.band(-1e-9).upper == 0);
  CHECK(law.band(0).lower == doctest::Approx(-A_I * Q));
  CHECK(law.band(X).lower == doctest::Approx(-A_I * (X + Q)));  // K06 (13): [0, X] is closed
  CHECK(law.band(std::nextafter(X, 1.0)).lower == -F);
  CHECK(law.band(1).upper == F);
  CHECK(law.band(X / 3).upper == doctest::Approx(A_O * (X / 3 + Q)));
}

TEST_CASE("the inequalities of K06 after (15) hold for random needles and membranes") {
  Noise noise(1);
  int expelling = 0;
  for (int i = 0; i < 20000; ++i) {
    const LawCase c = random_law(noise);
    const LawConstants<double> k(c.needle, c.membrane);
    REQUIRE(k.A_I > 0);
    REQUIRE(k.A_O < k.A_I);
    REQUIRE(k.A_I * (k.X + k.Q) > k.F);
    REQUIRE(k.A_O * (k.X + k.Q) < k.F);
    expelling += k.A_O < 0;
  }
  CHECK(expelling > 1000);  // A_O has both signs
}

TEST_CASE("float and double agree within the precision of float") {
  const ThinLawF f({1.08e-3f, 0.28f}, {570.f, 0.41f, 0.2f, 0.f});
  const ThinLaw d(paper_needle, paper_membrane(0));
  for (double q : {-1e-3, 0.0, 1e-3, 3e-3, 5e-3}) {
    CHECK(static_cast<double>(f.band(static_cast<float>(q)).lower) == doctest::Approx(d.band(q).lower).epsilon(1e-5));
    CHECK(static_cast<double>(f.band(static_cast<float>(q)).upper) == doctest::Approx(d.band(q).upper).epsilon(1e-5));
  }
}
