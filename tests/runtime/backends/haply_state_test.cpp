#include "punctura_runtime/backends/haply/state.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <string>

#include "core/support/cases.hpp"
#include "core/support/comma_locale.hpp"
#include "fuzz/haply_inputs.hpp"
#include "punctura/lab/plant/noise.hpp"
#include "punctura/model/vector3.hpp"
#include "punctura_runtime/backends/haply/json.hpp"

using namespace punctura;
using namespace punctura::haply;

namespace {

bool is_json(const std::string& text) {
  JsonReader json(text);
  json.skip();
  return json.whole();
}

std::optional<double> number(const std::string& text) { return JsonReader(text).number(); }

}  // namespace

TEST_CASE("only JSON as in RFC 8259 is accepted") {
  for (const char* good :
       {"0", "-0.5e-3", " [1, {\"a\": [true, false, null]}, \"\\u00e9\\n\\\"\"] ", "{}", "\"\xc3\xa9\""}) {
    CAPTURE(std::string(good));
    CHECK(is_json(good));
  }
  for (const char* bad :
       {"",        "01",          "1.",       ".5",      "-",        "+1",       "1e",         "1 2", "nul",
        "truth",   "[1,]",        "[,1]",     "{\"a\"}", "{\"a\":}", "{a:1}",    "{\"a\":1,}", "[1",  "\"a",
        "\"\\x\"", "\"\\u12g4\"", "\"a\nb\"", "[1}",     "NaN",      "Infinity", "'a'",        "\"\\"}) {
    CAPTURE(std::string(bad));
    CHECK_FALSE(is_json(bad));
  }
  CHECK_FALSE(is_json(std::string("\"a\0b\"", 5)));
}

TEST_CASE("the depth of nesting is limited") {
  const auto nested = [](std::size_t n) { return std::string(n, '[') + std::string(n, ']'); };
  CHECK(is_json(nested(32)));
  CHECK_FALSE(is_json(nested(33)));
  CHECK_FALSE(is_json(nested(200'000)));
}

TEST_CASE("numbers are read exactly in every locale; a number outside the range of a double is refused") {
  Noise noise(1);
  bool same = true;
  const punctura::test::CommaLocale comma;
  for (int i = 0; i < 1000; ++i) {
    const double value = std::ldexp(noise.uniform() - 0.5, static_cast<int>(noise.uniform() * 60) - 30);
    std::array<char, 512> out{};
    const std::string text(out.data(), write_force("a", ForceKey::values, {value, -value, 0}, out));
    same = same && number(text.substr(text.find("\"x\":") + 4)) == value;
  }
  CHECK(same);
  CHECK(number("0.1") == 0.1);
  CHECK(number("0") == 0.0);
  CHECK(number("0.00017976931348623157e312") == std::numeric_limits<double>::max());
  CHECK(number("4.9406564584124654e-324") == std::numeric_limits<double>::denorm_min());
  for (const char* outside : {"1e400", "-0.25e999", "0.5E+400", "1e99999999999999999999", "1e-400", "-5e-999"})
    CHECK_FALSE(number(outside));
  CHECK_FALSE(number(std::string(400, '9')));
  CHECK_FALSE(number("0." + std::string(500, '0') + "1"));
  CHECK_FALSE(number("\"1\""));
  CHECK_FALSE(number("null"));
}

TEST_CASE("a state is read with its fields in any order, and with unknown fields") {
  haply::State state;
  CHECK(read_state(R"({"new":{"x":[1,2]},"session_id":7,"inverse3":[
    {"state":{"mode":"x","cursor_position":{"z":0.15,"x":0.01,"y":-0.12,"w":9},)"
                   R"("current_cursor_force":{"x":0,"y":0,"z":1.5}},
     "status":{"calibrated":true,"in_use":false,"power_supply":null},"device_id":"049D"},
    {"device_id":"B"}],
    "wireless_verse_grip":[{"state":{"buttons":{"a":true}},"device_id":"first"},
      {"status":{"connected":false},"state":{"orientation":{"w":1,"x":0,"y":0,"z":0}}},
      {"device_id":"1102","state":{"orientation":{"w":1,"x":0,"y":0,"z":0},"buttons":)"
                   R"({"a":false,"b":true,"c":true,"d":true}}},
      {"device_id":"later"}]})",
                   state));
  CHECK(state.arm_count == 2);
  const Arm* arm = state.find("049D");
  REQUIRE(arm != nullptr);
  CHECK(arm->position == Vector{0.01, -0.12, 0.15});
  CHECK(arm->force == Vector{0, 0, 1.5});
  CHECK(arm->calibrated == true);
  CHECK(arm->in_use == false);
  CHECK_FALSE(arm->power_supply);
  CHECK_FALSE(state.find("B")->position);
  CHECK(state.find("") == arm);
  CHECK(state.find("C") == nullptr);
  CHECK(state.has_grip);
  CHECK(state.grip.id.view() == "1102");
  CHECK(state.grip.buttons == 6);

  CHECK(read_state(R"({"verse_grip":[{"state":{"orientation":{"w":1,"x":0,"y":0,"z":0},"button":true}}]})", state));
  CHECK(state.has_grip);
  CHECK(state.grip.buttons == 1);
  CHECK(state.arm_count == 0);
}

TEST_CASE("a field of the wrong type counts as missing; text that is not JSON is refused") {
  haply::State state;
  for (const char* text : {"{}", R"({"inverse3":null})", R"({"inverse3":{}})", R"({"inverse3":[]})"}) {
    CHECK(read_state(text, state));
    CHECK(state.find("") == nullptr);
    CHECK_FALSE(state.has_grip);
  }
  for (const char* position :
       {"null", "[1,2,3]", "{\"x\":1,\"y\":2}", "{\"x\":1,\"y\":2,\"z\":\"3\"}", "{\"x\":1,\"y\":2,\"z\":1e999}"}) {
    CHECK(read_state("{\"inverse3\":[{\"state\":{\"cursor_position\":" + std::string(position) + "}},3]}", state));
    CHECK(state.arm_count == 2);
    CHECK_FALSE(state.arms[0].position);
  }
  CHECK_FALSE(read_state("", state));
  CHECK_FALSE(read_state("[]", state));
  CHECK_FALSE(read_state("{\"inverse3\":[{\"state\":{\"cursor_position\":{\"x\":1", state));
  CHECK_FALSE(read_state("{} {}", state));
  std::string many = "{\"inverse3\":[{}";
  for (int i = 0; i < 20; ++i) many += ",{}";
  CHECK(read_state(many + "]}", state));
  CHECK(state.arm_count == state.arms.size());
}

TEST_CASE("a device's name is kept if a command can contain it unescaped") {
  CHECK(Name("049D").view() == "049D");
  for (const char* bad : {"a\\u0041", "a b", "\x01", "\xc3\xa9"}) CHECK(Name(bad).empty());
  CHECK(Name(std::string(64, 'x')).view().size() == 64);
  CHECK(Name(std::string(65, 'x')).empty());
  std::array<char, 512> out{};
  const double widest = -1.2345678901234567e-308;
  CHECK(write_force(std::string(64, 'x'), ForceKey::vector, {widest, widest, widest}, out) < 300);
}

TEST_CASE("our axes are the service's axes rotated by 90 degrees about x; the grip points along its own y") {
  CHECK(ours({1, 2, 3}) == std::array<double, 3>{1, 3, -2});
  CHECK(theirs(ours({1, 2, 3})) == Vector{1, 2, 3});
  CHECK(pointing({1, 0, 0, 0}) == std::array<double, 3>{0, 0, -1});  // straight away from the user
  const double r = std::sqrt(0.5);
  const auto down = pointing({2 * r, -2 * r, 0, 0});  // of any length
  REQUIRE(down);
  CHECK((*down)[1] == doctest::Approx(-1));
  const auto right = pointing({r, 0, 0, -r});
  REQUIRE(right);
  CHECK((*right)[0] == doctest::Approx(1));
  CHECK_FALSE(pointing({0, 0, 0, 0}));
  CHECK_FALSE(pointing({1e300, 1e300, 0, 0}));
}

TEST_CASE("reading ends for every input: random frames, random texts, and valid ones with changed bytes") {
  Noise noise(20);  // no CHECK: it fails by a crash, a sanitizer or a time limit
  for (int i = 0, n = test::cases(20'000); i < n; ++i) test::read_anything(test::spoilt_input(noise));
}
