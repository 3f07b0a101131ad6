#include <doctest/doctest.h>

#include <algorithm>
#include <set>
#include <string>

#include "../support/paper_scene.hpp"
#include "punctura/scene/by_path.hpp"

using namespace punctura;
using namespace punctura::test;

namespace {

/// "membrane.profile[].depth" of "membrane[0].profile[3].depth".
std::string without_numbers(std::string path) {
  for (std::size_t i = path.find('['); i != std::string::npos; i = path.find('[', i + 1))
    path.erase(i + 1, path.find(']', i) - i - 1);
  return path.starts_with("membrane[]") ? path.erase(8, 2) : path;
}

}  // namespace

TEST_CASE("each number of a scene has one key, and the keys of a table are different") {
  Scene scene = paper_scene();
  for (const char* path : {"syringe.bore", "coupling.relaxation[1].stiffness", "membrane[0].grip_table[2].grip",
                           "membrane[0].profile[1].depth"})
    make_room(scene, path);
  CHECK(scene.relaxation.size() == 2);
  CHECK(scene.membranes[0].tissue.grip_table.size() == 3);
  std::set<std::string> keys, paths;
  for (const SceneKey& key : scene_keys()) {
    CHECK(keys.insert(std::string(key.table) + "." + key.key).second);
    paths.insert(std::string(key.table) + "." + key.name);
  }
  for_each_value(scene, [&](const std::string& path, const Field&, double) {
    const std::string name = without_numbers(path);
    const bool entry = name.ends_with("[]");  // of a vector
    CHECK_MESSAGE(paths.contains(entry ? name.substr(0, name.size() - 2) : name), path);
  });
}

TEST_CASE("a number without a default is required, and check() finds that it is not given") {
  Scene scene;
  scene.syringe.emplace();
  scene.membranes.emplace_back();
  std::set<std::string> found, required;
  for (const Problem& p : check(scene)) found.insert(without_numbers(p.path));
  for (const SceneKey& key : scene_keys())
    if (key.required() && key.kind != KeyKind::text) required.insert(std::string(key.table) + "." + key.name);
  CHECK(found == required);
}

TEST_CASE("words and texts are set by their paths, and an unknown one is a problem") {
  Scene scene = paper_scene();
  const ScenePlaces places(scene);
  std::vector<Problem> problems;
  CHECK(places.set("servo.solver", "paper", problems));
  CHECK(places.set("membrane[0].name", "skin", problems));
  CHECK(places.set("display.force_scale", "automatic", problems));
  CHECK(scene.servo.solver == Solver::paper);
  CHECK(scene.membranes[0].name == "skin");
  CHECK(scene.display.automatic);
  CHECK(!places.set("servo.solver", "fast", problems));
  CHECK(!places.set("needle.color", "red", problems));
  CHECK(!places.set("display.force_scale", "off", problems));
  CHECK(scene.display.automatic);  // an error changes nothing
  REQUIRE(problems.size() == 3);
  CHECK(line_of(problems[0]) == "servo.solver: \"fast\" is unknown; it must be one of \"paper\", \"exact\"");
  CHECK(places.number("needle.color") == nullptr);
}
