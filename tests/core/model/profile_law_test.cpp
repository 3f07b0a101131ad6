// A profile averaged over the path through a wall, against quadrature of K06 (16).
#include "punctura/model/profile_law.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <vector>

#include "../support/cases.hpp"
#include "../support/random_profile.hpp"
#include "punctura/model/thick_law.hpp"

using namespace punctura;
using namespace punctura::test;

namespace {

/// K06 (16) by the midpoint rule between neighbouring knots, where it is exact.
Band<double> profile_quadrature(const Profile& profile, double q, double U, double H) {
  std::vector<double> ends{q - U, q};
  for (const Knot& knot : profile.used())
    if (knot.depth > q - U && knot.depth < q) ends.push_back(knot.depth);
  std::sort(ends.begin(), ends.end());
  Band<double> sum{0, 0};
  for (std::size_t i = 1; i < ends.size(); ++i) {
    const auto middle = profile_at(profile, ends[i - 1] + (ends[i] - ends[i - 1]) / 2);
    sum.lower += middle.lower * (ends[i] - ends[i - 1]);
    sum.upper += middle.upper * (ends[i] - ends[i - 1]);
  }
  return {sum.lower / H, sum.upper / H};
}

/// Depths in and around every piece.
std::vector<double> profile_depths(Noise& noise, const Profile& profile, double U) {
  std::vector<double> depths;
  for (const Knot& knot : profile.used()) depths.insert(depths.end(), {knot.depth, knot.depth + U});
  for (int j = 0; j < 30; ++j) depths.push_back(between(noise, -0.1, 1.2) * (end_of(profile) + U));
  return depths;
}

std::vector<Problem> profile_problems(std::vector<Knot> knots) {
  std::vector<Problem> problems;
  check_profile(knots, "profile", problems);
  return problems;
}

}  // namespace

TEST_CASE("a profile law is the average of its profile over the path, by quadrature of (16)") {
  Noise noise(120);
  double worst = 0;
  for (int i = 0; i < cases(400); ++i) {
    const Profile profile = random_profile(noise);
    const double H = between_log(noise, 1e-5, 2e-2), cos_beta = std::cos(between(noise, 0, 1.39)), U = H / cos_beta;
    const auto pieces = ProfileLaw(profile, H).pieces(cos_beta);
    REQUIRE(pieces.count <= 2 * profile.count + 1);
    REQUIRE(std::is_sorted(pieces.breaks.begin(), pieces.breaks.end()));
    for (const double q : profile_depths(noise, profile, U)) {
      const auto band = pieces.band(q), exact = profile_quadrature(profile, q, U, H);
      const double error = std::max(std::abs(band.lower - exact.lower), std::abs(band.upper - exact.upper));
      worst = std::max(worst, error / (largest(profile) / cos_beta));
    }
  }
  MESSAGE("largest difference, relative to the law's largest force: " << worst);
  CHECK(worst < 1e-11);
}

TEST_CASE("the lower edge of a profile law is <= 0 and <= the upper edge; it is 0 in front and constant behind") {
  Noise noise(121);
  for (int i = 0; i < cases(200); ++i) {
    const Profile profile = random_profile(noise);
    const double H = noise.uniform() < 0.2 ? 0 : between_log(noise, 1e-5, 2e-2);
    const ProfileLaw law(profile, H);
    const double rounding = 1e-12 * largest(profile);
    for (const double q : profile_depths(noise, profile, H)) {
      const auto band = law.band(q);
      REQUIRE(band.lower <= rounding);
      REQUIRE(band.lower <= band.upper + rounding);
    }
    const Knot& last = profile.knots[profile.count - 1];
    CHECK(law.band(last.depth + H + 1).lower == last.lower);
    CHECK(law.band(last.depth + H + 1).upper == last.upper);
    CHECK(law.band(profile.knots[0].depth - 1e-9).lower == 0);
  }
}

TEST_CASE("a profile law of thickness 0 is its profile / cos(beta)") {
  Noise noise(122);
  for (int i = 0; i < cases(200); ++i) {
    const Profile profile = random_profile(noise);
    const double cos_beta = std::cos(between(noise, 0, 1.39));
    const auto pieces = ProfileLaw(profile, 0).pieces(cos_beta);
    for (const double q : profile_depths(noise, profile, 0)) {
      const auto band = pieces.band(q), exact = profile_at(profile, q);
      REQUIRE(std::abs(band.lower - exact.lower / cos_beta) <= 1e-11 * largest(profile) / cos_beta);
      REQUIRE(std::abs(band.upper - exact.upper / cos_beta) <= 1e-11 * largest(profile) / cos_beta);
    }
  }
}

TEST_CASE("K06's thin law as a profile of three knots gives K06's thick law") {
  Noise noise(123);
  for (int i = 0; i < cases(300); ++i) {
    const LawCase c = random_law(noise);
    const ThickLaw k06(c.needle, c.membrane, c.obliquity);
    const auto& [X, A_I, A_O, Q, F] = k06.constants();
    Profile profile;
    profile.add(0, -A_I * Q, A_O * Q);
    profile.add(X, -A_I * (X + Q), A_O * (X + Q));
    profile.add(X, -F, F);
    const ProfileLaw law(profile, c.membrane.thickness, std::cos(c.obliquity));
    const double most = largest(profile) / std::cos(c.obliquity);
    for (const double q : profile_depths(noise, profile, k06.path_length())) {
      REQUIRE(std::abs(law.band(q).lower - k06.band(q).lower) <= 1e-11 * most);
      REQUIRE(std::abs(law.band(q).upper - k06.band(q).upper) <= 1e-11 * most);
    }
  }
}

TEST_CASE("the force is the sum of the knots' values times their weights") {
  Noise noise(124);
  for (int i = 0; i < cases(200); ++i) {
    const Profile profile = random_profile(noise);
    const double H = noise.uniform() < 0.2 ? 0 : between_log(noise, 1e-5, 2e-2), cos_beta = between(noise, 0.2, 1);
    const auto pieces = ProfileLaw(profile, H).pieces(cos_beta);
    std::vector<double> depths, weights(profile.count);
    for (const Knot& knot : profile.used()) depths.push_back(knot.depth);
    for (const double q : profile_depths(noise, profile, H / cos_beta)) {
      profile_weights<double>(depths, H, cos_beta, q, weights);
      double lower = 0, upper = 0;
      for (std::size_t k = 0; k < profile.count; ++k) {
        lower += weights[k] * profile.knots[k].lower;
        upper += weights[k] * profile.knots[k].upper;
      }
      REQUIRE(std::abs(lower - pieces.band(q).lower) <= 1e-11 * largest(profile) / cos_beta);
      REQUIRE(std::abs(upper - pieces.band(q).upper) <= 1e-11 * largest(profile) / cos_beta);
    }
  }
}

TEST_CASE("float and double agree on a profile law within the precision of float") {
  Noise noise(125);
  double worst = 0;
  for (int i = 0; i < cases(200); ++i) {
    const Profile profile = random_profile(noise);
    const auto f = [](double x) { return static_cast<float>(x); };
    BasicProfile<float> single;
    Profile rounded;
    for (const auto& [depth, lower, upper] : profile.used()) {
      single.add(f(depth), f(lower), f(upper));
      rounded.add(f(depth), f(lower), f(upper));
    }
    const float H = f(between_log(noise, 1e-3, 1e-2));  // a thinner wall loses digits where a depth and U are added
    const ProfileLaw law(rounded, static_cast<double>(H));
    const BasicProfileLaw<float> small(single, H);
    for (int j = 0; j < 20; ++j) {
      const float q = f(between(noise, -0.1, 1.2) * (end_of(profile) + static_cast<double>(H)));
      worst =
          std::max(worst, std::abs(static_cast<double>(small.band(q).lower) - law.band(q).lower) / largest(profile));
    }
  }
  MESSAGE("largest difference, relative: " << worst);
  CHECK(worst < 2e-4);
}

TEST_CASE("everything that is no profile is told") {
  CHECK(profile_problems({{0, -1, 1}, {1e-3, -2, 1}, {1e-3, -1, 1}}).empty());
  CHECK(profile_problems({}).at(0).reason == "must have 1 to 32 knots");
  CHECK(profile_problems({{-1, 0, 0}}).at(0).path == "profile[0].depth");
  CHECK(profile_problems({{0, 0, 0}, {0, -1, 1}}).at(0).reason == "must be greater than the depth of the first knot");
  CHECK(profile_problems({{0, 0, 0}, {1, 0, 0}, {0.5, 0, 0}}).at(0).path == "profile[2].depth");
  CHECK(profile_problems({{0, 0, 0}, {1, -1, 0}, {1, 0, 0}, {1, 0, 0}}).at(0).path == "profile[3].depth");
  CHECK(profile_problems({{0, 1, 2}}).at(0).reason == "must be from -1e+06 to 0 N: the lower edge resists insertion");
  CHECK(profile_problems({{0, -1, -2}}).at(0).reason == "must not be greater than upper at the same knot");
  CHECK(profile_problems({{0, -1, std::numeric_limits<double>::quiet_NaN()}}).at(0).path == "profile[0].upper");
}
