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
inline constexpr std::size_t longest_list = 1000;

/// The types that build() and build_insertion() make.
using SceneInsertion = BasicInsertion<double>;
using SceneServo = BasicServoStep<double>;

/// Sets a word of the scene. Adds a problem if there is no such path or word. Returns whether there was none.
bool set_word(Scene& scene, const std::string& path, std::string_view word, std::vector<Problem>& problems);

/// Gives a list of the scene, such as "membrane[0].profile", at least `count` rows. The numbers of new rows are NaN.
/// Returns false if there is no such list.
bool make_rows(Scene& scene, const std::string& list, std::size_t count);

}  // namespace punctura::c
