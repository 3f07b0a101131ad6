#include "punctura/model/validity.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "../support/random_law.hpp"

using namespace punctura;

TEST_CASE("check() reports all broken bounds at once") {
  std::vector<Problem> problems;
  CHECK_FALSE(check(Needle{-1e-3, 2}, "needle", problems));
  CHECK_FALSE(check(Membrane{0, -0.1, 0, -1e-3}, "membrane[0]", problems));
  REQUIRE(problems.size() == 6);
  CHECK(problems[0].path == "needle.diameter");
  CHECK(problems[1].path == "needle.tip_angle");
  CHECK(problems[2].path == "membrane[0].stiffness");
  CHECK(problems[5].path == "membrane[0].thickness");
  CHECK(problems[5].value == -1e-3);
}

TEST_CASE("check() reports a number that is not finite") {
  std::vector<Problem> problems;
  CHECK_FALSE(check(Needle{std::nan(""), INFINITY}, "needle", problems));
  REQUIRE(problems.size() == 2);
  CHECK(problems[0].reason == "must be a finite number");
  CHECK(problems[1].reason == "must be a finite number");
}

TEST_CASE("insertion needs mu tan(theta) < 1, and the message has the largest friction that is allowed") {
  std::vector<Problem> problems;
  CHECK_FALSE(check_insertion({1.08e-3, 0.28}, {570, 0.41, 3.6, 1e-3}, "membrane[1]", problems));
  REQUIRE(problems.size() == 1);
  CHECK(problems[0].path == "membrane[1].friction");
  CHECK(problems[0].reason == "the largest value that is allowed with this tip angle is 3.477, K06 (7)");
  for (const double angle : {1e-4, 0.1, 0.28, 0.5, 0.7853981633974483, 1.2, 1.57}) {
    const double most = largest_friction(angle);
    CHECK(check_insertion({1.08e-3, angle}, {570, 0.41, most, 1e-3}, "membrane[1]", problems));
    CHECK_FALSE(check_insertion({1.08e-3, angle}, {570, 0.41, 1.002 * most, 1e-3}, "membrane[1]", problems));
  }
}

TEST_CASE("permitted values give no problem") {
  Noise noise(6);
  std::vector<Problem> problems;
  for (int i = 0; i < 1000; ++i) {
    const auto c = test::random_law(noise);
    CHECK(check(c.needle, "needle", problems));
    CHECK(check(c.membrane, "membrane", problems));
    CHECK(check_insertion(c.needle, c.membrane, "membrane", problems));
  }
  CHECK(problems.empty());
}
