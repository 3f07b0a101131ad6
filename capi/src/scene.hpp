// A scene behind the C ABI.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "errors.hpp"
#include "punctura/scene/build.hpp"
#include "punctura/scene/scene.hpp"

struct punctura_scene {
  punctura::Scene scene;
};

namespace punctura::c {

/// More rows than any list of a scene may have. The check of the scene has the limit of each list.

/// The types that build() and build_insertion() make.
using SceneInsertion = BasicInsertion<double>;
using SceneServo = BasicServoStep<double>;

}  // namespace punctura::c
