// Handles of the C ABI that free themselves, and a scene of the core behind the C ABI.
#pragma once

#include <doctest/doctest.h>

#include <memory>
#include <string>

#include "punctura.h"
#include "punctura/scene/scene.hpp"

namespace capi_test {

template <auto free>
struct Free {
  void operator()(auto* handle) const noexcept { free(handle); }
};
using SceneHandle = std::unique_ptr<punctura_scene, Free<punctura_scene_free>>;
using InsertionHandle = std::unique_ptr<punctura_insertion, Free<punctura_insertion_free>>;
using Proxy1dHandle = std::unique_ptr<punctura_proxy1d, Free<punctura_proxy1d_free>>;
using Proxy3dHandle = std::unique_ptr<punctura_proxy3d, Free<punctura_proxy3d_free>>;
using ServoHandle = std::unique_ptr<punctura_servo, Free<punctura_servo_free>>;

/// make(&handle) makes the object.
template <typename Handle>
Handle made(auto&& make) {
  typename Handle::pointer handle = nullptr;
  INFO(punctura_last_error());
  REQUIRE(make(&handle) == PUNCTURA_OK);
  return Handle(handle);
}

/// The scene through the structs of the C ABI.
inline SceneHandle through_c(const punctura::Scene& scene) {
  punctura_setup setup;
  REQUIRE(punctura_setup_init(&setup, sizeof setup) == PUNCTURA_OK);
  setup.name = scene.name.c_str();
  setup.diameter = scene.needle.diameter;
  setup.tip_angle = scene.needle.tip_angle;
  setup.stiffness = scene.coupling.stiffness;
  setup.damping = scene.coupling.damping;
  setup.rate = scene.servo.rate;
  setup.low_pass = scene.servo.low_pass;
  auto handle = made<SceneHandle>([&](auto** to) { return punctura_scene_new(&setup, to); });
  const auto word = [&](const char* path, bool second, const char* a, const char* b) {
    REQUIRE(punctura_scene_set_word(handle.get(), path, second ? b : a) == PUNCTURA_OK);
  };
  word("servo.solver", scene.servo.solver == punctura::Solver::exact, "paper", "exact");
  word("servo.conditioning", scene.servo.conditioning == punctura::Conditioning::line_fit, "low_pass", "line_fit");
  word("needle.direction", scene.direction == punctura::Direction::motion, "stylus", "motion");
  for (const auto& placed : scene.membranes) {
    punctura_membrane m;
    REQUIRE(punctura_membrane_init(&m, sizeof m) == PUNCTURA_OK);
    m.name = placed.name.c_str();
    m.stiffness = placed.membrane.stiffness;
    m.precompression = placed.membrane.precompression;
    m.friction = placed.membrane.friction;
    m.thickness = placed.membrane.thickness;
    for (std::size_t i = 0; i < 3; ++i) {
      m.point[i] = placed.point[i];
      m.inward_normal[i] = placed.inward_normal[i];
    }
    REQUIRE(punctura_scene_add_membrane(handle.get(), &m) == PUNCTURA_OK);
  }
  return handle;
}

}  // namespace capi_test
