// The law of measured tissue as a function of depth: its limits, its curves and what it remembers.
#include "punctura/model/tissue_law.hpp"

#include <doctest/doctest.h>

#include <functional>

#include "../support/cases.hpp"
#include "../support/random_tissue.hpp"
#include "punctura/model/profile_law.hpp"

using namespace punctura;
using namespace punctura::test;

namespace {

/// The band of K06 (16) from a thin law, by Simpson's rule on short intervals.
double tissue_quadrature(const std::function<double(double)>& thin, double q, double H,
                         const std::vector<double>& kinks) {
  std::vector<double> ends{q - H, q};
  for (const double kink : kinks)
    if (kink > q - H && kink < q) ends.push_back(kink);
  std::sort(ends.begin(), ends.end());
  double sum = 0;
  for (std::size_t i = 1; i < ends.size(); ++i) {
    const double a = ends[i - 1], h = (ends[i] - a) / 64;
    const double inside = 1e-9 * h;  // off the kinks themselves
    for (int j = 0; j < 64; ++j)
      sum += h / 6 * (thin(a + h * j + inside) + 4 * thin(a + h * (j + 0.5)) + thin(a + h * (j + 1) - inside));
  }
  return sum / H;
}

}  // namespace

TEST_CASE("with its additions off, the law of tissue has the pieces of K06's thick law, bit for bit") {
  Noise noise(130);
  Tissue straight, no_tail;
  straight.grip = GripShape::exponential;  // with a growth of 0
  no_tail.tail_length = 1e-3;              // with a floor of 1
  for (const Tissue& tissue : {Tissue{}, straight, no_tail}) {
    CHECK(is_k06(tissue));
    for (int i = 0; i < cases(200); ++i) {
      LawCase c = random_law(noise);
      if (i % 5 == 0) c.membrane.thickness = 0;
      const ThickLaw k06(c.needle, c.membrane, c.obliquity);
      const TissueLaw law(c.needle, c.membrane, tissue, std::cos(c.obliquity));
      for (int j = 0; j < 30; ++j) {
        const double q = between(noise, -0.1, 1.2) * (k06.constants().X + k06.path_length());
        REQUIRE(law.band(q).lower == k06.band(q).lower);
        REQUIRE(law.band(q).upper == k06.band(q).upper);
      }
      for (const double at : k06.pieces().breaks) REQUIRE(law.band(at).lower == k06.band(at).lower);
    }
  }
}

TEST_CASE("K06's numbers, given as a tip length, a table or a profile, give K06's thick law") {
  Noise noise(131);
  for (int i = 0; i < cases(100); ++i) {
    const LawCase c = random_law(noise);
    const ThickLaw k06(c.needle, c.membrane, c.obliquity);
    const auto& [X, A_I, A_O, Q, F] = k06.constants();
    const double kappa = c.membrane.stiffness, pre = c.membrane.precompression, w = c.needle.diameter;
    Tissue tip, table, profile;
    tip.tip_length = X;
    table.grip = GripShape::table;
    table.grip_table = {{0, pre}, {2 * w, 2 * kappa * w + pre}};
    profile.profile = {{0, -A_I * Q, A_O * Q}, {X, -A_I * (X + Q), A_O * (X + Q)}, {X, -F, F}};
    for (const Tissue& tissue : {tip, table, profile}) {
      const TissueLaw law(c.needle, c.membrane, tissue, std::cos(c.obliquity));
      const double most = A_I * (X + Q) / std::cos(c.obliquity);
      for (int j = 0; j < 30; ++j) {
        const double q = between(noise, -0.1, 1.2) * (X + k06.path_length());
        REQUIRE(std::abs(law.band(q).lower - k06.band(q).lower) <= 1e-11 * most);
        REQUIRE(std::abs(law.band(q).upper - k06.band(q).upper) <= 1e-11 * most);
      }
    }
  }
}

TEST_CASE("the chords of an exponential grip stay within their stated error, which is small") {
  Noise noise(132);
  int followed = 0;
  double worst = 0;
  for (int i = 0; i < cases(150); ++i) {
    LawCase c = random_law(noise, 5e-5);
    if (c.membrane.friction * std::tan(c.needle.tip_angle) > 0.9) continue;
    const double w = c.needle.diameter, H = c.membrane.thickness;
    Tissue tissue;
    tissue.grip = GripShape::exponential;
    tissue.growth = between(noise, -4, 4) / w;
    tissue.tip_length = between(noise, 0.5, 2) * tip_length(c.needle);
    const auto made = profile_of(c.needle, c.membrane, tissue);
    const ProfileLaw law(made.profile, H);
    const GripFactors<double> factor(c.needle, c.membrane);
    const double X = tissue.tip_length, b = tissue.growth, full = grip_at(c.membrane, tissue, w);
    CHECK(full == doctest::Approx(c.membrane.precompression + c.membrane.stiffness * std::expm1(b * w) / b));
    const auto thin = [&](double q) {
      if (q < 0) return 0.0;
      if (q > X) return -factor.shaft * full;
      return -factor.in * (c.membrane.precompression + c.membrane.stiffness * std::expm1(b * w * q / X) / b);
    };
    double error = 0, most = 0;
    for (int j = 0; j < 200; ++j) {
      const double q = (X + H) * j / 199.0, exact = tissue_quadrature(thin, q, H, {0, X});
      error = std::max(error, std::abs(law.band(q).lower - exact));
      most = std::max(most, std::abs(exact));
    }
    REQUIRE(error <= made.error + 1e-9 * most);
    if (!made.follows) continue;
    ++followed;
    worst = std::max(worst, error / most);
    REQUIRE(made.profile.count <= max_knots);
  }
  MESSAGE("largest error of chords: " << worst << " of the largest force");
  CHECK(worst <= most_chord_error);
  CHECK(followed > cases(150) / 2);
}

TEST_CASE("a grip that no 28 chords follow is told, with what to do") {
  TissueCase c = plain_tissue();
  c.membrane.thickness = 0;
  c.tissue.grip = GripShape::exponential;
  c.tissue.growth = 6 / c.needle.diameter;
  std::vector<Problem> problems;
  CHECK(!check_curve(c.needle, c.membrane, c.tissue, "membrane[0]", problems));
  REQUIRE(problems.size() == 1);
  CHECK(problems[0].path == "membrane[0].growth");
  CHECK(problems[0].reason.find("28 chords") != std::string::npos);
}

TEST_CASE("behind the tail the shaft's friction is its floor") {
  TissueCase c = plain_tissue();
  c.tissue.tail_length = 0.6e-3;
  c.tissue.tail_floor = 0.4;
  const double F = ThickLaw(c.needle, c.membrane).constants().F, X = tip_length(c.needle), H = c.membrane.thickness;
  for (const double H_now : {0.0, H}) {
    c.membrane.thickness = H_now;
    const TissueLaw law = c.law();
    CHECK(law.band(1).lower == doctest::Approx(-0.4 * F));
    CHECK(law.band(1).upper == doctest::Approx(0.4 * F));
    CHECK(law.band(X + 0.3e-3 + H_now / 2).lower == doctest::Approx(-0.7 * F));  // the middle of the tail
  }
}

TEST_CASE("pieces that follow a hole as it grows have the bits of pieces that are computed for it at once") {
  Noise noise(134);
  int passed = 0, whole = 0;
  for (int i = 0; i < cases(150); ++i) {
    TissueCase c = random_tissue(noise);
    if (i % 6 == 0) c.membrane.thickness = 0;
    const TissueLaw law = c.law();
    const double reach = c.tissue.tip_length + c.path_length(), cos_beta = std::cos(c.obliquity);
    auto grown = law.pieces(cos_beta);
    TissueLaw::Memory hole{};
    for (int step = 0; step < 20; ++step) {
      hole.cut += between(noise, 0.01, 0.15) * reach;
      if (noise.uniform() < 0.3) hole.made = hole.cut;
      law.refresh(grown, hole);
      const auto at_once = law.pieces(cos_beta, hole);
      passed += at_once.made.at > c.tissue.tip_length, whole += !at_once.cuts && hole.made < at_once.whole;
      for (int j = 0; j < 20; ++j) {
        const double q = j == 0 ? hole.cut : j == 1 ? hole.made : between(noise, -0.1, 1.3) * reach;
        grown.look_at(q);
        const auto a = grown.band(q), b = at_once.band(q);
        REQUIRE(grown.index(q) == at_once.index(q));
        REQUIRE((a.lower == b.lower && a.upper == b.upper));
      }
    }
  }
  CHECK((passed > 0 && whole > 0));
}

TEST_CASE("a table of the grip that cannot be is told") {
  const auto reason = [](std::vector<GripPoint> points) {
    Tissue tissue;
    tissue.grip = GripShape::table;
    tissue.grip_table = std::move(points);
    std::vector<Problem> problems;
    check(tissue, "membrane[0]", problems);
    return problems.empty() ? "" : problems[0].path + " " + problems[0].reason;
  };
  CHECK(reason({{0, 0.1}, {1e-3, 0.5}}) == "");
  CHECK(reason({}) == "membrane[0].grip_table must have 1 to 28 points");
  CHECK(reason({{1e-3, 0.1}, {1e-3, 0.5}}).starts_with("membrane[0].grip_table[1].opening"));
  CHECK(reason({{0, -0.1}}).starts_with("membrane[0].grip_table[0].grip"));
  Tissue tissue;
  tissue.set = 1.1;
  tissue.tail_floor = -0.1;
  std::vector<Problem> problems;
  check(tissue, "membrane[0]", problems);
  CHECK(problems.size() == 2);
}
