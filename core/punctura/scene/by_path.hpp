// Sets the fields of a scene by their paths: what readers of files do.
#pragma once

#include <algorithm>
#include <charconv>
#include <cstddef>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "punctura/scene/keys.hpp"

namespace punctura {

/// The longest list that a reader makes. More rows than any check permits, so that the check reports them.
inline constexpr std::size_t longest_list = 1000;

namespace detail {
/// The index below `most` behind `name` in a path, as in "membrane[3].friction"; empty if the path does not begin so.
inline std::optional<std::size_t> index_after(std::string_view path, std::string_view name, std::size_t most) {
  if (path.substr(0, name.size()) != name || path.substr(name.size(), 1) != "[") return std::nullopt;
  std::size_t index = most;
  const char* first = path.data() + name.size() + 1;
  const auto [end, error] = std::from_chars(first, path.data() + path.size(), index);
  if (error != std::errc() || end == path.data() + path.size() || *end != ']' || index >= most) return std::nullopt;
  return index;
}
}  // namespace detail

/// "; did you mean X?" with the key of `known` that begins and ends as a path does, in more than two thirds of its
/// letters; otherwise empty.
template <typename Known>
std::string did_you_mean(std::string_view path, const Known& known) {
  std::string_view nearest;
  auto most = static_cast<std::ptrdiff_t>(path.size() * 2 / 3 + 1);
  for (const auto& [key, value] : known) {
    const auto begin = std::mismatch(path.begin(), path.end(), key.begin(), key.end()).first - path.begin(),
               end = std::mismatch(path.rbegin(), path.rend(), key.rbegin(), key.rend()).first - path.rbegin();
    if (begin + end >= most) most = begin + end + 1, nearest = key;
  }
  return nearest.empty() ? std::string() : "; did you mean " + std::string(nearest) + "?";
}

/// Gives a list of the scene, such as "membrane[0].profile", at least `count` rows. The numbers of new rows are not
/// given. Returns false if there is no such list.
inline bool make_rows(Scene& scene, std::string_view list, std::size_t count) {
  bool found = false;
  const auto visit = [&](const std::string& path, const Field&, auto& value) {
    if constexpr (detail::is_list<std::remove_reference_t<decltype(value)>>)
      if (path == list) found = true, value.resize(std::max(value.size(), count));
  };
  if (const auto i = detail::index_after(list, "membrane", scene.membranes.size()))
    detail::visit_membrane("membrane[" + std::to_string(*i) + "].", scene.membranes[*i], visit);
  else
    visit_scene(scene, visit);
  return found;
}

/// Makes the membrane, the syringe or the row of a list that a path is in. Their numbers are not given.
inline void make_room(Scene& scene, std::string_view path, std::size_t most_membranes = max_membranes) {
  if (const auto i = detail::index_after(path, "membrane", most_membranes))
    if (scene.membranes.size() <= *i) scene.membranes.resize(*i + 1);
  if (path.substr(0, 8) == "syringe." && !scene.syringe) scene.syringe.emplace();
  if (const auto close = path.rfind("]."); close != std::string_view::npos) {
    const std::string_view list = path.substr(0, path.rfind('[', close));
    if (const auto row = detail::index_after(path, list, longest_list); row && list != "membrane")
      make_rows(scene, list, *row + 1);
  }
}

/// The numbers, words and texts of a scene by their paths, to set them. Valid until the scene gets other membranes,
/// rows or a syringe.
class ScenePlaces {
 public:
  explicit ScenePlaces(Scene& scene) {
    for_each_value(scene, [&](const std::string& path, const Field&, double& number) { numbers_[path] = &number; });
    visit_scene(scene, [&](const std::string& path, const Field&, auto& value) {
      using Value = std::remove_reference_t<decltype(value)>;
      if constexpr (std::is_same_v<Value, double>)  // also of an outlet that nothing reads
        numbers_.try_emplace(path, &value);
      else if constexpr (std::is_enum_v<Value>)
        words_[path] = [&value](std::string_view word) {
          const auto found = enum_of<Value>(word);
          if (found) value = *found;
          return found ? std::string() : "\"" + std::string(word) + "\" is unknown; it must be " + one_of<Value>();
        };
      else if constexpr (std::is_same_v<Value, std::string>)
        words_[path] = [&value](std::string_view word) { return value = word, std::string(); };
    });
    words_["display.force_scale"] = [&scene](std::string_view word) {
      if (word != automatic_word) return std::string("must be a number or \"automatic\"");
      scene.display.automatic = true;
      return std::string();
    };
  }

  /// The number at a path; null if there is none.
  double* number(const std::string& path) const {
    const auto found = numbers_.find(path);
    return found == numbers_.end() ? nullptr : found->second;
  }

  /// Sets a word or a text. Adds a problem if there is no such path or word. Returns whether there was none.
  bool set(const std::string& path, std::string_view word, std::vector<Problem>& problems) const {
    if (!check_name(word, path, problems)) return false;
    const auto found = words_.find(path);
    const std::string reason =
        found == words_.end() ? "there is no such word in the scene" + did_you_mean(path, words_) : found->second(word);
    if (!reason.empty()) problems.push_back({path, not_given, reason});
    return reason.empty();
  }

  const std::map<std::string, double*>& numbers() const noexcept { return numbers_; }

 private:
  std::map<std::string, double*> numbers_;
  std::map<std::string, std::function<std::string(std::string_view)>> words_;
};

}  // namespace punctura
