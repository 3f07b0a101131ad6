// The laws in C++: the reference numbers of the paper's own parameters, and that float is double in short.
#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

#include "punctura/model/thick_law.hpp"
#include "punctura/model/validity.hpp"

using namespace punctura;

namespace {

const Needle needle{1.08e-3, 0.28};
const Membrane membrane{570, 0.41, 0.2, 1e-3};

}  // namespace

TEST_CASE("the constants of the paper's needle and membrane") {
  const LawConstants<double> c(needle, membrane);
  CHECK(c.X == doctest::Approx(3.7558120442572873e-3).epsilon(1e-13));
  CHECK(c.A_I == doctest::Approx(117.57056589624991).epsilon(1e-13));
  CHECK(c.A_O == doctest::Approx(19.210953071314766).epsilon(1e-13));
  CHECK(c.Q == doctest::Approx(2.5014342724910454e-3).epsilon(1e-13));
  CHECK(c.F == doctest::Approx(0.41024).epsilon(1e-13));
}

TEST_CASE("the thin law grows on the tip and is constant on the shaft") {
  const ThinLaw law(needle, membrane);
  const auto& [X, A_I, A_O, Q, F] = law.constants();
  CHECK(law.band(-1e-9).lower == 0);
  CHECK(law.band(X / 2).lower == doctest::Approx(-A_I * (X / 2 + Q)));
  CHECK(law.band(X / 2).upper == doctest::Approx(A_O * (X / 2 + Q)));
  CHECK(law.band(2 * X).lower == -F);
  CHECK(law.band(2 * X).upper == F);
}

TEST_CASE("the thick law is the average of the thin law over the path in the membrane") {
  for (const double beta : {0.0, 0.6, 1.3}) {
    const ThinLaw thin(needle, membrane);
    const ThickLaw thick(needle, membrane, beta);
    CHECK(thick.path_length() == doctest::Approx(1e-3 / std::cos(beta)));
    for (double q = -1e-3; q < 9e-3; q += 0.37e-3) {
      const int n = 20000;  // the midpoint rule; two jumps of phi cost it at most their height times U / (n H)
      double lower = 0, upper = 0;
      for (int i = 0; i < n; ++i) {
        const auto phi = thin.band(q - thick.path_length() * (i + 0.5) / n);
        lower += phi.lower / n;
        upper += phi.upper / n;
      }
      CHECK(std::abs(thick.band(q).lower - lower / std::cos(beta)) < 2e-4);
      CHECK(std::abs(thick.band(q).upper - upper / std::cos(beta)) < 2e-4);
    }
  }
}

TEST_CASE("the law in single precision is the law in double precision, rounded") {
  const ThickLawF single({1.08e-3F, 0.28F}, {570, 0.41F, 0.2F, 1e-3F}, 0.5F);
  const ThickLaw law(needle, membrane, 0.5);
  for (double q = -1e-3; q < 9e-3; q += 0.37e-3) {
    CHECK(static_cast<double>(single.band(static_cast<float>(q)).lower) ==
          doctest::Approx(law.band(q).lower).epsilon(1e-4));
    CHECK(static_cast<double>(single.band(static_cast<float>(q)).upper) ==
          doctest::Approx(law.band(q).upper).epsilon(1e-4));
  }
}

TEST_CASE("a needle too blunt for the friction is refused, with the reason") {
  std::vector<Problem> problems;
  CHECK_FALSE(check_insertion(needle, {570, 0.41, 3.6, 1e-3}, "membrane[1]", problems));
  REQUIRE(problems.size() == 1);
  CHECK(problems[0].path == "membrane[1].friction");
  CHECK(problems[0].reason == "insertion needs mu tan(theta) < 1, K06 (7); here 1.035");
}

TEST_CASE("every bound that is broken is named, all at once") {
  std::vector<Problem> problems;
  CHECK_FALSE(check(Needle{0, std::numbers::pi / 2}, "needle", problems));
  CHECK_FALSE(check(Membrane{-1, -1, 0, std::nan("")}, "", problems));
  REQUIRE(problems.size() == 6);
  CHECK(problems[1].path == "needle.tip_angle");
  CHECK(problems[5].path == "thickness");
}
