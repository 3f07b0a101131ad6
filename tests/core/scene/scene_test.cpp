#include <doctest/doctest.h>

#include <string>

#include "../support/paper_scene.hpp"
#include "punctura/scene/build.hpp"

using namespace punctura;
using namespace punctura::test;

TEST_CASE("a valid scene has no problem and can be built") {
  CHECK(check(paper_scene()).empty());
  CHECK_NOTHROW(build(paper_scene()));
  CHECK_NOTHROW(build_insertion<float>(paper_scene()));
}

TEST_CASE("an invalid scene is refused with all of its problems") {
  auto scene = paper_scene();
  scene.needle.diameter = 0;
  scene.coupling = {0, -1};
  scene.servo.rate = 10;
  scene.servo.low_pass = -1;
  scene.membranes[0].membrane.stiffness = -5;
  scene.membranes[0].inward_normal = {0, 0, 0};
  scene.membranes[0].point[2] = std::nan("");
  const auto problems = check(scene);
  CHECK(problems.size() == 8);
  try {
    build(scene);
    FAIL("nothing was thrown");
  } catch (const SceneError& error) {
    CHECK(error.problems().size() == problems.size());
    for (const auto& p : problems) CHECK(std::string(error.what()).find(p.path) != std::string::npos);
  }
}

TEST_CASE("numbers whose forces no double can hold are refused, K06's and those of measured tissue") {
  for (const double set : {0.0, 0.5}) {
    auto scene = paper_scene();
    scene.membranes[0].tissue.set = set;
    scene.membranes[0].membrane.stiffness = 1e300;
    CHECK(check(scene).empty());
    scene.needle.diameter = 1e9;
    REQUIRE(check(scene).size() == 1);
    const std::string line = line_of(check(scene)[0]);
    CHECK(line.starts_with("membrane[0]: the law: its band at the depth "));
    CHECK(line.ends_with("both must be finite"));
  }
}

TEST_CASE("K06 (7) is checked for each membrane, and the path contains the number of the membrane") {
  auto scene = paper_scene();
  scene.membranes.push_back(scene.membranes[0]);
  scene.membranes[1].membrane.friction = 3.6;
  const auto problems = check(scene);
  REQUIRE(problems.size() == 1);
  CHECK(problems[0].path == "membrane[1].friction");
}

TEST_CASE("the lumen is between the membrane with blood behind it and the next one") {
  auto scene = paper_scene();
  const auto at_depth = [&](double depth) {
    auto placed = scene.membranes[0];
    placed.point = {0, -depth, 0};
    return placed;
  };
  scene.membranes = {at_depth(6e-3), at_depth(2e-3), at_depth(4e-3)};
  CHECK(!lumen(scene));
  scene.membranes[1].behind = Behind::blood;
  CHECK(check(scene).empty());
  CHECK((lumen(scene) == std::pair<std::size_t, std::size_t>(1, 2)));

  scene.membranes[2].behind = Behind::blood;
  REQUIRE(check(scene).size() == 1);
  CHECK(check(scene)[0].path == "membrane[2].behind");
  scene.membranes[1].behind = scene.membranes[2].behind = Behind::tissue;
  scene.membranes[0].behind = Behind::blood;
  REQUIRE(check(scene).size() == 1);
  CHECK(check(scene)[0].path == "membrane[0].behind");
}

TEST_CASE("each word of a look and of a space is found again, and no other word is") {
  for (const auto word : words_of<Look>) CHECK((word_of(*enum_of<Look>(word)) == word));
  for (const auto word : words_of<Behind>) CHECK((word_of(*enum_of<Behind>(word)) == word));
  CHECK(word_of(Look::artery_wall) == "artery wall");
  CHECK(word_of(Behind::cerebrospinal_fluid) == "cerebrospinal fluid");
  CHECK(!enum_of<Look>("glass"));
  CHECK(!enum_of<Behind>(""));
}

TEST_CASE("a scene needs 1 to 64 membranes") {
  auto scene = paper_scene();
  const auto one = scene.membranes[0];
  scene.membranes.clear();
  CHECK(check(scene).size() == 1);
  scene.membranes.assign(64, one);
  CHECK(check(scene).empty());
  scene.membranes.assign(65, one);
  REQUIRE(check(scene).size() == 1);
  CHECK(check(scene)[0].path == "membrane");
}

TEST_CASE("safety limits that disable safety are refused, together with the problems of the scene") {
  auto scene = paper_scene();
  scene.needle.diameter = 0;
  GateLimits gate;
  gate.max_speed = 0;
  gate.axis_tolerance = 1;
  ForceLimits limits{0, 0, -1, 0};
  try {
    build(scene, gate, limits);
    FAIL("nothing was thrown");
  } catch (const SceneError& error) {
    CHECK(error.problems().size() == 7);
    CHECK(error.problems()[3].path == "limits.max_force");
  }
}

TEST_CASE("an inward normal can have any length") {
  auto scene = paper_scene();
  scene.membranes[0].inward_normal = {0, -17, 0};
  auto a = build_insertion(scene), b = build_insertion(paper_scene());
  for (int k = 0; k < 1600; ++k) {
    const Vector3d p(0, 1e-3 - 5e-3 * k / 1600.0, 0);
    REQUIRE(a.step(p, {0, -1, 0}) == b.step(p, {0, -1, 0}));
  }
}
