// The characteristic depths of a crossing, compared with K06's formulas, and the curves for plots.
#include "punctura/lab/events/crossing.hpp"

#include <doctest/doctest.h>

#include "../support/given_law.hpp"
#include "../support/random_law.hpp"
#include "punctura/lab/events/law_curve.hpp"
#include "punctura/model/tissue_law.hpp"

using namespace punctura;
using namespace punctura::test;

namespace {

Crossing crossing_of(const LawCase& c, double cos_beta) {
  return crossing(ThickLaw(c.needle, c.membrane), c.needle, c.membrane.thickness, cos_beta);
}

}  // namespace

TEST_CASE("for K06's law, crossing() agrees with the formulas of the paper") {
  Noise noise(21);
  for (int i = 0; i < 2000; ++i) {
    LawCase c = random_law(noise);
    if (i % 10 == 0) c.membrane.thickness = 0;
    const double cos_beta = std::cos(c.obliquity), U = c.membrane.thickness / cos_beta;
    const auto [X, A_I, A_O, Q, F] = ThickLaw(c.needle, c.membrane).constants();
    const Crossing turns = crossing_of(c, cos_beta);
    // At max(U, X) the slope of -Phi_I is (A_I (m - X - Q) + F) / H. Behind it, the slope decreases by A_I / H per
    // metre.
    const double peak = std::max(U, X) + std::max(0.0, std::min(U, X) - X - Q + F / A_I);
    REQUIRE(turns.cos_beta == cos_beta);
    REQUIRE(turns.far_face == U);
    REQUIRE(turns.through == X + U);
    REQUIRE(turns.peak == doctest::Approx(peak).epsilon(1e-12));
    REQUIRE(turns.again == turns.peak - 0.1 * X);
    REQUIRE(turns.shaft == doctest::Approx(F / cos_beta).epsilon(1e-12));
  }
}

TEST_CASE("no depth has more resistance than the peak") {
  Noise noise(22);
  for (int i = 0; i < 200; ++i) {
    const LawCase c = random_law(noise);
    const auto law = ThickLaw(c.needle, c.membrane).pieces(std::cos(c.obliquity));
    const Crossing turns = crossing_of(c, std::cos(c.obliquity));
    const double largest = -law.band(turns.peak).lower;
    for (int k = 0; k <= 1000; ++k) REQUIRE(-law.band(1.2 * turns.through * k / 1000).lower <= largest * (1 + 1e-12));
  }
}

TEST_CASE("a grazing needle counts as 80 degrees, and a needle without a direction as 0 degrees") {
  Noise noise(23);
  const LawCase c = random_law(noise);
  CHECK(crossing_of(c, 0.01).cos_beta == grazing_cosine<double>);
  CHECK(crossing_of(c, 1.0 + 1e-12).cos_beta == 1);
  CHECK(crossing_of(c, std::numeric_limits<double>::quiet_NaN()).cos_beta == 1);
}

TEST_CASE("the crossing of a custom law is at its breaks, and breaks at infinity do not change it") {
  const Needle needle = paper_needle;
  // The resistance grows by 100 N/m up to 2 mm and decreases by 50 N/m up to 4 mm. Behind it, the friction is 0.05 N.
  const PiecewiseBand<double, 4> table{
      {0, 2e-3, 4e-3}, {{{}, {0, {0, -100, 0}, {}}, {2e-3, {-0.2, 50, 0}, {}}, {4e-3, {-0.05, 0, 0}, {}}}}};
  for (const Crossing& turns :
       {crossing(GivenLaw<4>{table}, needle, 1e-3, 1), crossing(GivenLaw<9>{with_room<9>(table)}, needle, 1e-3, 1)}) {
    CHECK(turns.peak == 2e-3);
    CHECK(turns.through == 4e-3);
    CHECK(turns.shaft == 0.05);
    CHECK(turns.far_face == 1e-3);
    CHECK(turns.again == 2e-3 - 0.1 * tip_length(needle));
  }
  const BasicThickLaw<float> small({1.08e-3f, 0.28f}, {570, 0.41f, 0.2f, 1e-3f});
  CHECK(crossing(small, needle, 1e-3, 1).through == doctest::Approx(tip_length(needle) + 1e-3));
}

TEST_CASE("the crossing of a wall of tissue: its cutting raises the peak, its tail ends behind the pop") {
  const Membrane membrane = paper_membrane(1e-3);
  Tissue tissue;
  tissue.cutting = 0.3;
  tissue.tail_length = 2e-3;
  tissue.tail_floor = 0.5;
  const double X = tip_length(paper_needle);
  const TissueLaw law(paper_needle, membrane, tissue);
  const Crossing plain = crossing(ThickLaw(paper_needle, membrane), paper_needle, 1e-3, 1);
  const Crossing turns = crossing(law, paper_needle, 1e-3, 1);
  CHECK(turns.through == doctest::Approx(X + 1e-3));  // the slanted face is through; the tail comes behind it
  CHECK(turns.settled == doctest::Approx(X + 2e-3 + 1e-3));
  CHECK(turns.shaft == doctest::Approx(0.5 * plain.shaft));
  CHECK(-law.band(turns.peak).lower == doctest::Approx(0.3 - ThickLaw(paper_needle, membrane).band(plain.peak).lower));
  const LawCurve curve = law_curve(law.pieces());
  CHECK(curve.depth.back() > turns.through);
  CHECK(curve.lower.back() == doctest::Approx(-turns.shaft));
}

TEST_CASE("a law whose resistance never decreases has no pop") {
  const PiecewiseBand<double, 3> table{{0, 2e-3}, {{{}, {0, {0, -100, 0}, {}}, {2e-3, {-0.2, 0, 0}, {}}}}};
  CHECK(std::isinf(crossing(GivenLaw<3>{table}, paper_needle, 0, 1).through));
}

TEST_CASE("the curve of a law has points on both sides of each break") {
  for (const double thickness : {0.0, 1e-3, 9e-3}) {
    const auto law = ThickLaw(paper_needle, paper_membrane(thickness), 0.5).pieces();
    const LawCurve curve = law_curve(law);
    CHECK(std::is_sorted(curve.depth.begin(), curve.depth.end(), std::less_equal<>()));
    CHECK(curve.depth.front() < 0);
    CHECK(curve.depth.back() > law.breaks[3]);
    for (const double at : law.breaks)
      for (const double depth : {std::nextafter(at, -1.0), at, std::nextafter(at, 1.0)})
        CHECK(std::count(curve.depth.begin(), curve.depth.end(), depth) == 1);
    for (std::size_t i = 0; i < curve.depth.size(); ++i) {
      CHECK(curve.lower[i] == law.band(curve.depth[i]).lower);
      CHECK(curve.upper[i] == law.band(curve.depth[i]).upper);
    }
  }
}
