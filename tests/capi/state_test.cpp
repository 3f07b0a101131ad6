// The C ABI: state as bytes, peek without commit, and wrong arguments.
#include <cmath>
#include <string>
#include <vector>

#include "c99.h"
#include "handles.hpp"

namespace {
using namespace capi_test;

constexpr double capi_axis[3] = {0, -2, 0};  // of any length

/// The force at 1 mm a tick, N.
double deeper(punctura_insertion* insertion, int tick) {
  const double p[3] = {0, 1e-3 - 1e-5 * tick, 0};
  double force[3] = {0, 0, 0};
  CHECK(punctura_insertion_step(insertion, p, capi_axis, force) == PUNCTURA_OK);
  return force[1];
}

struct Inserted {
  SceneHandle scene{c99_scene()};
  InsertionHandle insertion = made<InsertionHandle>([&](auto** to) { return punctura_insertion_new(scene.get(), to); });
};
}  // namespace

TEST_CASE("C ABI: a restored state continues with the same bits; wrong bytes are refused and change nothing") {
  const Inserted one;
  for (int k = 0; k < 200; ++k) deeper(one.insertion.get(), k);
  std::vector<unsigned char> state(punctura_insertion_state_size(one.insertion.get()));
  REQUIRE(state.size() > 0);
  REQUIRE(punctura_insertion_save(one.insertion.get(), state.data(), state.size()) == PUNCTURA_OK);
  const double first = deeper(one.insertion.get(), 200), second = deeper(one.insertion.get(), 201);
  CHECK(first > 0);

  const Inserted other;
  CHECK(punctura_insertion_restore(other.insertion.get(), state.data(), state.size() - 1) == PUNCTURA_BAD_STATE);
  CHECK(std::string(punctura_last_error()).find("bytes") != std::string::npos);
  state[60] ^= 1;
  CHECK(punctura_insertion_restore(other.insertion.get(), state.data(), state.size()) == PUNCTURA_BAD_STATE);
  state[60] ^= 1;
  CHECK(deeper(other.insertion.get(), 0) == 0);
  REQUIRE(punctura_insertion_restore(other.insertion.get(), state.data(), state.size()) == PUNCTURA_OK);
  CHECK(deeper(other.insertion.get(), 200) == first);
  CHECK(deeper(other.insertion.get(), 201) == second);

  CHECK(punctura_insertion_save(one.insertion.get(), state.data(), state.size() - 1) == PUNCTURA_BAD_ARGUMENT);
  REQUIRE(punctura_scene_set(other.scene.get(), "membrane[0].stiffness", 600) == PUNCTURA_OK);
  const auto stiffer = made<InsertionHandle>([&](auto** to) { return punctura_insertion_new(other.scene.get(), to); });
  CHECK(punctura_insertion_restore(stiffer.get(), state.data(), state.size()) == PUNCTURA_BAD_STATE);
}

TEST_CASE("C ABI: a peek changes nothing until it is committed; a step discards it") {
  const Inserted a, b;
  for (int k = 0; k < 200; ++k) CHECK(deeper(a.insertion.get(), k) == deeper(b.insertion.get(), k));
  const double far[3] = {0, -5e-3, 0};
  double force[3];
  CHECK(punctura_insertion_commit(a.insertion.get()) == PUNCTURA_NO_PEEK);
  CHECK(punctura_insertion_peek(a.insertion.get(), far, capi_axis, force) == PUNCTURA_OK);
  CHECK(force[1] > 0);
  CHECK(deeper(a.insertion.get(), 200) == deeper(b.insertion.get(), 200));
  CHECK(punctura_insertion_commit(a.insertion.get()) == PUNCTURA_NO_PEEK);
}

TEST_CASE("C ABI: what is no number gives NaN and changes nothing; NULL is refused") {
  const Inserted a, b;
  for (int k = 0; k < 150; ++k) CHECK(deeper(a.insertion.get(), k) == deeper(b.insertion.get(), k));
  const double no_place[3] = {0, std::nan(""), 0}, no_axis[3] = {0, 0, 0}, p[3] = {0, 0, 0};
  double force[3] = {0, 0, 0};
  CHECK(punctura_insertion_step(a.insertion.get(), no_place, capi_axis, force) == PUNCTURA_NO_NUMBER);
  CHECK(std::isnan(force[1]));
  CHECK(punctura_insertion_step(a.insertion.get(), p, no_axis, force) == PUNCTURA_NO_NUMBER);
  CHECK(std::isnan(force[1]));
  CHECK(deeper(a.insertion.get(), 150) == deeper(b.insertion.get(), 150));

  CHECK(punctura_insertion_step(nullptr, p, capi_axis, force) == PUNCTURA_BAD_ARGUMENT);
  CHECK(std::isnan(force[0]));
  double forces[6] = {0, 0, 0, 0, 0, 0};
  CHECK(punctura_insertion_run(a.insertion.get(), 2, p, capi_axis, 1, forces) == PUNCTURA_BAD_ARGUMENT);
  CHECK(std::isnan(forces[0]));
  CHECK(std::isnan(forces[5]));
  CHECK(std::string(punctura_last_error()).starts_with("axis_stride must be 0"));
  CHECK(punctura_insertion_run(a.insertion.get(), 2, nullptr, capi_axis, 1, forces) == PUNCTURA_BAD_ARGUMENT);
  CHECK(std::string(punctura_last_error()) == "a pointer is NULL");
  CHECK(std::isnan(punctura_proxy1d_step(nullptr, 0)));
  CHECK(punctura_servo_step(nullptr, nullptr, nullptr) == PUNCTURA_BAD_ARGUMENT);
  CHECK(punctura_insertion_new(nullptr, nullptr) == PUNCTURA_BAD_ARGUMENT);
  CHECK(punctura_insertion_state_size(nullptr) == 0);
  punctura_insertion_free(nullptr);
  punctura_scene_free(nullptr);
  CHECK(punctura_supports_abi(PUNCTURA_ABI) == 1);
  CHECK(punctura_supports_abi(PUNCTURA_ABI + 1) == 0);
}

TEST_CASE("C ABI: a caller with a longer struct gets what this library knows, and with a shorter one is refused") {
  const Inserted one;
  struct {
    punctura_membrane_tick known;
    double added_later;
  } longer;
  longer.known.struct_size = sizeof longer;
  longer.added_later = 7;
  CHECK(punctura_insertion_membrane(one.insertion.get(), 0, &longer.known) == PUNCTURA_OK);
  CHECK(longer.added_later == 7);
  CHECK(longer.known.struct_size == sizeof longer);
  longer.known.struct_size = std::size_t{4'000'000'000};
  CHECK(punctura_insertion_membrane(one.insertion.get(), 0, &longer.known) == PUNCTURA_BAD_ARGUMENT);
  punctura_setup setup;
  CHECK(punctura_setup_init(&setup, std::size_t{4'000'000'000}) == PUNCTURA_BAD_ARGUMENT);
  longer.known.struct_size = 8;
  CHECK(punctura_insertion_membrane(one.insertion.get(), 0, &longer.known) == PUNCTURA_BAD_ARGUMENT);
}

TEST_CASE("C ABI: a text whose size is too large is refused before anything behind its end is read") {
  const char* const text = "# the size of this text is wrong";
  punctura_scene* scene = nullptr;
  for (const auto from : {punctura_scene_from_toml, punctura_scene_from_values}) {
    CHECK(from(text, std::size_t{5'000'000'000}, &scene) == PUNCTURA_BAD_SCENE);
    CHECK(std::string(punctura_last_error()).find("KiB: no scene needs that") != std::string::npos);
    CHECK(from(text, std::size_t{100'000}, &scene) == PUNCTURA_BAD_SCENE);
    CHECK(std::string(punctura_last_error()).find("text: ends after 32 bytes with a NUL") != std::string::npos);
  }
}

TEST_CASE("C ABI: a wrong path names the near one, and a number of the syringe asks for the syringe") {
  const SceneHandle scene(c99_scene());
  const auto says = [](punctura_status status, const char* words) {
    return status != PUNCTURA_OK && std::string(punctura_last_error()).find(words) != std::string::npos;
  };
  CHECK(says(punctura_scene_set(scene.get(), "membrane[1].friction", 1), "did you mean membrane[0].friction?"));
  CHECK(says(punctura_scene_set(scene.get(), "membrane[0].outflow_pressure", 1), "add the syringe first"));
  CHECK(says(punctura_scene_set_word(scene.get(), "servo.solvr", "exact"), "did you mean servo.solver?"));
  CHECK(!says(punctura_scene_set(scene.get(), "x", 1), "did you mean"));
}
