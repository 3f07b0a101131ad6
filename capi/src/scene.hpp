// A scene behind the C ABI.
#pragma once

#include <memory>
#include <string_view>
#include <utility>
#include <vector>

#include "errors.hpp"
#include "punctura/scene/build.hpp"
#include "punctura/scene/scene.hpp"

struct punctura_scene {
  punctura::Scene scene;
};

namespace punctura::c {

/// A new scene from a text. read(text, scene, problems) adds what is wrong.
template <typename Read>
punctura_status scene_from(const char* text, std::size_t size, punctura_scene** scene, Read&& read) {
  return guarded([&] {
    if (!text || !scene) return null_pointer();
    auto made = std::make_unique<punctura_scene>();
    std::vector<Problem> problems;
    read(std::string_view(text, size), made->scene, problems);
    if (!problems.empty()) return fail(std::move(problems));
    *scene = made.release();
    return ok;
  });
}

}  // namespace punctura::c
