// The C ABI: scenes by path and from the text of a scene file, and their problems.
#include <cmath>
#include <cstdio>
#include <limits>
#include <map>
#include <string>
#include <string_view>

#include "c99.h"
#include "handles.hpp"
#include "punctura/scene/build.hpp"
#include "support/comma_locale.hpp"

namespace {
using namespace capi_test;

constexpr std::string_view capi_text = R"(name = "two"
[needle]
diameter_mm = 1.08
tip_angle_deg = 12.1
direction = "motion"
[coupling]
stiffness_N_per_mm = 0.4
damping_Ns_per_mm = 0.001
[servo]
rate_hz = 2000
solver = "paper"
conditioning = "line_fit"
encoder_step_mm = 0.055
[display]
force_scale = 0.5
[syringe]
bore_mm = 11.99
liquid_mL = 2.5
friction_N = 0.8
compliance_mL_per_kPa = 0.002
resistance_kPa_s_per_mL = 1.5
[[membrane]]
name = "skin"
stiffness_N_per_mm = 0.57
precompression_N = 0.41
friction = 0.2
thickness_mm = 2
point_mm = [0, -0.1, 1.7]
inward_normal = [0, -1, 0]
look = "skin"
behind = "epidural space"
outflow_pressure_kPa = 4.8
)";

SceneHandle parsed(std::string_view text) {
  return made<SceneHandle>([&](auto** to) { return punctura_scene_from_toml(text.data(), text.size(), to); });
}

/// The problems of a text: their reasons by path.
std::map<std::string, std::string> problems_of(std::string text) {
  punctura_scene* scene = nullptr;
  CHECK(punctura_scene_from_toml(text.data(), text.size(), &scene) == PUNCTURA_BAD_SCENE);
  CHECK(scene == nullptr);
  std::map<std::string, std::string> problems;
  for (int i = 0; i < punctura_problem_count(); ++i) {
    const char *path = nullptr, *reason = nullptr;
    double value = 0;
    CHECK(punctura_problem(i, &path, &value, &reason) == PUNCTURA_OK);
    problems[path] = reason;
  }
  return problems;
}

std::string with(std::string_view old, std::string_view now) {
  std::string text(capi_text);
  const auto at = text.find(old);
  REQUIRE(at != std::string::npos);
  return text.replace(at, old.size(), now);
}
}  // namespace

TEST_CASE("C ABI: a scene file gives the doubles nearest to its decimal numbers") {
  const auto scene = parsed(capi_text);
  const std::map<std::string, double> expected = {
      {"needle.diameter", 1.08e-3},
      {"needle.tip_angle", 0.2111848394913139},  // the double nearest to 12.1 pi / 180
      {"coupling.stiffness", 400},
      {"coupling.damping", 1},
      {"servo.rate", 2000},
      {"servo.low_pass", 300},
      {"servo.encoder_step", 0.055e-3},
      {"display.force_scale", 0.5},
      {"syringe.bore", 11.99e-3},
      {"syringe.liquid", 2.5e-6},
      {"syringe.air", 0},
      {"syringe.compliance", 2e-12},
      {"syringe.resistance", 1.5e9},
      {"membrane[0].stiffness", 570},
      {"membrane[0].thickness", 2e-3},
      {"membrane[0].point[1]", -0.1e-3},
      {"membrane[0].point[2]", 1.7e-3},
      {"membrane[0].outflow_pressure", 4800},
      {"membrane[0].behind_pressure", 0},
  };
  for (const auto& [path, value] : expected) {
    INFO(path);
    double given = std::nan("");
    CHECK(punctura_scene_get(scene.get(), path.c_str(), &given) == PUNCTURA_OK);
    CHECK(given == value);
  }
  CHECK(punctura_scene_check(scene.get()) == PUNCTURA_OK);
}

TEST_CASE("C ABI: the digits of a scene file become SI units without a rounding in between") {
  std::string text = with("diameter_mm = 1.08", "diameter_mm = 2.1855455533155981734");
  text = text.replace(text.find("[0, -0.1, 1.7]"), 14, "[0x10, -4_5.5_0E-1, # é\n  2.1855455533155981734]");
  const auto scene = parsed("\xef\xbb\xbf" + text);
  const auto value = [&](const char* path) {
    double given = 0;
    CHECK(punctura_scene_get(scene.get(), path, &given) == PUNCTURA_OK);
    return given;
  };
  CHECK(value("needle.diameter") == 0.0021855455533155983);  // the double of the text, times 1e-3, is ...598
  CHECK(value("membrane[0].point[0]") == 0.016);
  CHECK(value("membrane[0].point[1]") == -4.55e-3);
  CHECK(value("membrane[0].point[2]") == 0.0021855455533155983);
}

TEST_CASE("C ABI: a text that is no TOML, or far too large, is refused; the program lives on") {
  for (const char* text : {"[+]", "[=", "[#", "[.a]", "[\xc3\xa9]", "[,", "[(]", "[", "[[", "[\"", "a = [", "a.",
                           "\xff", "\xce\x9d = 1"}) {
    INFO(text);
    CHECK(problems_of(text).begin()->first.substr(0, 6) == "line 1");
  }
  // Every short text of these characters.
  const std::string_view parts[] = {"[", "]", "{", "}", "\"",       "'",        "\\",           "#",
                                    "=", ".", ",", "+", "-",        "_",        "\n",           "\r",
                                    " ", "a", "e", "0", "\xc3\xa9", "\xce\x9d", "\xe3\x80\x80", "\x01"};
  for (const auto a : parts)
    for (const auto b : parts)
      for (const auto c : parts) {
        const std::string text = std::string(a).append(b).append(c);
        punctura_scene* scene = nullptr;
        REQUIRE(punctura_scene_from_toml(text.data(), text.size(), &scene) == PUNCTURA_BAD_SCENE);
      }
  const auto repeated = [](std::string_view part, int times) {
    std::string all;
    for (int i = 0; i < times; ++i) all += part;
    return all;
  };
  CHECK(problems_of(repeated("a.", 50000) + "a = 1")["text"] == "a key has more than 16 dots");
  CHECK(problems_of("a = " + repeated("[", 50000))["text"].find("nested") != std::string::npos);
  CHECK(problems_of("# " + repeated("x", 300000))["text"].find("256 KiB") != std::string::npos);
  CHECK(problems_of(repeated("[[membrane]]\n", 65))["membrane"].find("64") != std::string::npos);
  CHECK(problems_of("name = '" + repeated(".", 50) + "' # " + repeated("[", 50)).contains("needle"));
  CHECK(problems_of("\"\\u001b[2J\" = 1").contains("a key"));
}

TEST_CASE("C ABI: names are text in UTF-8 without control characters, whichever way they come") {
  const SceneHandle scene(c99_scene());
  for (const char* word : {"\xff", "\xc3", "\xbf\xbf", "\xc0\x80", "\xed\xa0\x80", "\xf4\x90\x80\x80", "a\nb",
                           "\x1b[31m", "\x7f", "\xc2\x9b"}) {
    for (const char* path : {"name", "membrane[0].name", "servo.solver"}) {
      CHECK(punctura_scene_set_word(scene.get(), path, word) == PUNCTURA_BAD_SCENE);
      CHECK(std::string(punctura_last_error()) ==
            std::string(path) + ": must be text in UTF-8 without control characters (a new line, an escape)");
    }
    auto named = through_c([&] {
      punctura::Scene wrong;
      wrong.name = word;
      wrong.needle = {1e-3, 0.3};
      wrong.coupling = {400, 1};
      wrong.membranes.push_back({word, {500, 0.4, 0.2, 0}, {0, 0, 0}, {0, -1, 0}});
      return wrong;
    }());
    CHECK(punctura_scene_check(named.get()) == PUNCTURA_BAD_SCENE);
    CHECK(punctura_problem_count() == 2);
  }
  for (const char* word : {"", "Haut, 2 mm\t(weich)", "\xc3\xa9", "\xe7\x9a\xae", "\xf0\x9f\xa9\xb8"})
    CHECK(punctura_scene_set_word(scene.get(), "name", word) == PUNCTURA_OK);
  CHECK(problems_of(with("name = \"two\"", "name = \"\\u001b[31m\"")).contains("name"));

  std::string longest;
  for (int i = 0; i < 200; ++i) longest += "\xc3\xa9";
  CHECK(punctura_scene_set_word(scene.get(), "name", longest.c_str()) == PUNCTURA_OK);
  CHECK(punctura_scene_set_word(scene.get(), "name", (longest + "x").c_str()) == PUNCTURA_BAD_SCENE);
  CHECK(std::string(punctura_last_error()) == "name: must have at most 200 characters; it has 201");
}

TEST_CASE("C ABI: numbers in messages have a point, and all their digits, in every locale") {
  const punctura::test::CommaLocale comma;
#ifndef _WIN32
  REQUIRE(comma.works());
#endif
  const auto scene = parsed(with("friction = 0.2", "friction = 0.25"));
  const auto set = [&](const char* path, double v) { CHECK(punctura_scene_set(scene.get(), path, v) == PUNCTURA_OK); };
  set("membrane[0].stiffness", 0.57);
  CHECK(std::string(punctura_scene_unusual(scene.get())) ==
        "membrane[0].stiffness = 0.57 N/m is unusual. If you meant 0.57 N/mm, write 570");
  set("membrane[0].thickness", -1e-7);
  set("membrane[0].friction", 7.25);
  CHECK(punctura_scene_check(scene.get()) == PUNCTURA_BAD_SCENE);
  const std::string problems = punctura_last_error();
  CHECK(problems.find("membrane[0].thickness = -1e-07: must be") != std::string::npos);
  CHECK(problems.find("membrane[0].friction = 7.25: the largest value that is allowed with this tip angle is 4.664,") !=
        std::string::npos);
  punctura::Scene core;
  core.needle = {1.08e-3, 0.28};
  core.membranes.push_back({"skin", {570, 0.41, 0.2, -1e-7}, {0, 0, 0}, {0, -1, 0}});
  try {
    punctura::build_insertion(core);
    FAIL("the scene is wrong");
  } catch (const punctura::SceneError& error) {
    CHECK(std::string(error.what()).find("membrane[0].thickness = -1e-07: must be") != std::string::npos);
  }
}

TEST_CASE("C ABI: all problems of a scene file, with the keys of the file") {
  auto found = problems_of(with("friction = 0.2", "frictoin = 0.2"));
  CHECK(found.size() == 2);
  CHECK(found.contains("membrane[0].frictoin"));
  CHECK(found["membrane[0].friction"] == "is missing");
  found = problems_of(with("tip_angle_deg = 12.1", "tip_angle_deg = 12.1\ntip_angle_rad = 0.2\ngauge = 9"));
  CHECK(found.size() == 2);
  CHECK(found.contains("needle.tip_angle_rad"));
  found = problems_of(with("friction = 0.2", "friction = 7"));
  CHECK(found.size() == 1);
  CHECK(found["membrane[0].friction"].find("K06 (7)") != std::string::npos);
  found = problems_of(with("thickness_mm = 2", "thickness_mm = -2"));
  CHECK(found.contains("membrane[0].thickness_mm"));
  CHECK(std::string(punctura_last_error()).find("-0.002") != std::string::npos);
  found = problems_of(with("\"skin\"\nbehind", "\"sky\"\nbehind"));
  CHECK(found["membrane[0].look"].find("\"vein wall\"") != std::string::npos);
  found = problems_of(with("[0, -0.1, 1.7]", "[0, 1]"));
  CHECK(found["membrane[0].point_mm"] == "must be three numbers, [x, y, z]");
  CHECK(problems_of("name = ").begin()->first.substr(0, 6) == "line 1");
  CHECK(problems_of("x = 1\n[extra]\ny = 2").size() == 6);
}

TEST_CASE("C ABI: numbers and words of a scene by their path; every problem is reported") {
  const SceneHandle scene(c99_scene());
  punctura_field field;
  field.struct_size = sizeof field;
  const int count = punctura_scene_field_count(scene.get());
  CHECK(count > 10);
  for (int i = 0; i < count; ++i) {
    REQUIRE(punctura_scene_field(scene.get(), i, &field) == PUNCTURA_OK);
    double value = 0;
    CHECK(punctura_scene_get(scene.get(), field.path, &value) == PUNCTURA_OK);
    CHECK(value == field.value);
    CHECK(value >= field.min);
  }
  CHECK(punctura_scene_field(scene.get(), count, &field) == PUNCTURA_BAD_ARGUMENT);
  CHECK(punctura_scene_set(scene.get(), "membrane[1].friction", 1) == PUNCTURA_BAD_ARGUMENT);
  CHECK(punctura_scene_set_word(scene.get(), "servo.solver", "fast") == PUNCTURA_BAD_SCENE);

  CHECK(punctura_scene_set(scene.get(), "needle.diameter", 0) == PUNCTURA_OK);
  CHECK(punctura_scene_set(scene.get(), "membrane[0].stiffness", -1) == PUNCTURA_OK);
  CHECK(punctura_scene_check(scene.get()) == PUNCTURA_BAD_SCENE);
  CHECK(punctura_problem_count() == 2);
  punctura_insertion* none = nullptr;
  CHECK(punctura_insertion_new(scene.get(), &none) == PUNCTURA_BAD_SCENE);
  CHECK(none == nullptr);
  CHECK(punctura_scene_set(scene.get(), "needle.diameter", 1e-3) == PUNCTURA_OK);
  CHECK(punctura_scene_set(scene.get(), "membrane[0].stiffness", 500) == PUNCTURA_OK);

  CHECK(std::string(punctura_scene_unusual(scene.get())) == "");
  CHECK(std::string(punctura_scene_unusual(nullptr)) == "");
  CHECK(punctura_scene_set(scene.get(), "needle.diameter", 1.08) == PUNCTURA_OK);
  CHECK(punctura_scene_check(scene.get()) == PUNCTURA_OK);
  CHECK(std::string(punctura_scene_unusual(scene.get())) ==
        "needle.diameter = 1.08 m is unusual. If you meant 1.08 mm, write 0.00108");
  CHECK(punctura_scene_set(scene.get(), "needle.diameter", 1e-3) == PUNCTURA_OK);

  CHECK(punctura_scene_set_word(scene.get(), "display.force_scale", "automatic") == PUNCTURA_OK);
  CHECK(punctura_scene_check(scene.get()) == PUNCTURA_OK);
  CHECK(punctura_scene_set(scene.get(), "display.force_scale", 0.3) == PUNCTURA_OK);
  const auto copy = made<SceneHandle>([&](auto** to) { return punctura_scene_copy(scene.get(), to); });
  double scale = 0;
  CHECK(punctura_scene_get(copy.get(), "display.force_scale", &scale) == PUNCTURA_OK);
  CHECK(scale == 0.3);

  punctura_limits limits;
  REQUIRE(punctura_limits_init(&limits, sizeof limits) == PUNCTURA_OK);
  limits.ramp_time = 0;
  punctura_servo* servo = nullptr;
  CHECK(punctura_servo_new(scene.get(), &limits, &servo) == PUNCTURA_BAD_SCENE);
  CHECK(std::string(punctura_last_error()).find("limits.ramp_time") != std::string::npos);
}

TEST_CASE("C ABI: a scene from lines is the scene from a file; wrong lines are named") {
  const auto file = parsed(capi_text);
  std::string lines = "# a comment\nname = \"two\"\nneedle.direction = \"motion\"\r\n\nservo.solver = \"paper\"\n";
  for (int i = 0; i < punctura_scene_field_count(file.get()); ++i) {
    punctura_field field;
    field.struct_size = sizeof field;
    REQUIRE(punctura_scene_field(file.get(), i, &field) == PUNCTURA_OK);
    char value[40];
    std::snprintf(value, sizeof value, "%.17g", field.value);
    lines += std::string(field.path) + " = " + value + "\n";
  }
  const auto from_lines = [](const std::string& text, punctura_scene** to) {
    return punctura_scene_from_values(text.data(), text.size(), to);
  };
  const auto scene = made<SceneHandle>([&](auto** to) { return from_lines(lines, to); });
  CHECK(punctura_scene_field_count(scene.get()) == punctura_scene_field_count(file.get()));
  for (int i = 0; i < punctura_scene_field_count(file.get()); ++i) {
    punctura_field a, b;
    a.struct_size = b.struct_size = sizeof a;
    REQUIRE(punctura_scene_field(file.get(), i, &a) == PUNCTURA_OK);
    REQUIRE(punctura_scene_field(scene.get(), i, &b) == PUNCTURA_OK);
    CHECK(std::string(a.path) == b.path);
    CHECK(a.value == b.value);
  }
  punctura_scene* none = nullptr;
  CHECK(from_lines(lines + "membrane[0].frictoin = 1\n", &none) == PUNCTURA_BAD_SCENE);
  CHECK(std::string(punctura_last_error()).find("frictoin\"; did you mean membrane[0].friction?") != std::string::npos);
  CHECK(from_lines(lines + "membrane[99999999999].friction = 1\nname\nx = 1e\n", &none) == PUNCTURA_BAD_SCENE);
  CHECK(punctura_problem_count() == 3);
  CHECK(from_lines("", &none) == PUNCTURA_BAD_SCENE);
  CHECK(none == nullptr);
}

TEST_CASE("a scene file beyond K06 gives its tissue, its lists and its branches; wrong lists are told") {
  const std::string beyond = with("outflow_pressure_kPa = 4.8", R"(grip = "exponential"
growth_per_mm = 0.5
cutting_N = 0.2
tail_length_mm = 1
tail_floor = 0.25
profile_depth_mm = [0, 1, 2.5]
profile_lower_N = [0, -0.4, -0.2]
profile_upper_N = [0, 0.05, 0.1])");
  const std::string_view damping = "damping_Ns_per_mm = 0.001";
  std::string text = beyond;
  text.insert(text.find(damping) + damping.size(),
              "\nrelaxation_stiffness_N_per_mm = [0.1, 0.05]\nrelaxation_time_constant_s = [0.2, 3]");
  const auto scene = parsed(text);
  for (const auto& [path, right] : std::map<std::string, double>{{"membrane[0].growth", 500},
                                                                 {"membrane[0].cutting", 0.2},
                                                                 {"membrane[0].tail_floor", 0.25},
                                                                 {"membrane[0].profile[2].depth", 2.5e-3},
                                                                 {"membrane[0].profile[1].lower", -0.4},
                                                                 {"coupling.relaxation[1].stiffness", 50},
                                                                 {"coupling.relaxation[0].time_constant", 0.2}}) {
    double value = 0;
    CAPTURE(path);
    CHECK(punctura_scene_get(scene.get(), path.c_str(), &value) == PUNCTURA_OK);
    CHECK(value == right);
  }
  text.replace(text.find("[0, -0.4, -0.2]"), 15, "[0, 0.4]");
  const auto problems = problems_of(text);
  CHECK(problems.contains("membrane[0].profile_lower_N[1]"));
  CHECK(problems.contains("membrane[0].profile[2].lower"));
}
