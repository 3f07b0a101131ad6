// A scene behind the C ABI.
#pragma once

#include "errors.hpp"
#include "punctura/scene/build.hpp"
#include "punctura/scene/scene.hpp"

struct punctura_scene {
  punctura::Scene scene;
};

namespace punctura::c {

/// The types that build() and build_insertion() make.
using SceneInsertion = BasicInsertion<double>;
using SceneServo = BasicServoStep<double>;

}  // namespace punctura::c
