// Scenes from lines "path = value" in SI units. Needs no TOML reader: an FMU carries its scene in this form.
#include <charconv>
#include <map>
#include <memory>

#include "punctura/model/decimal.hpp"
#include "punctura/scene/values.hpp"
#include "scene.hpp"

namespace punctura::c {
namespace {

/// The index below `most` behind `name` in a path, as in "membrane[3].friction"; empty if the path does not begin so.
std::optional<std::size_t> index_after(std::string_view path, std::string_view name, std::size_t most) {
  if (path.substr(0, name.size()) != name || path.substr(name.size(), 1) != "[") return std::nullopt;
  std::size_t index = most;
  const char* first = path.data() + name.size() + 1;
  const auto [end, error] = std::from_chars(first, path.data() + path.size(), index);
  if (error != std::errc() || end == path.data() + path.size() || *end != ']' || index >= most) return std::nullopt;
  return index;
}

/// Makes the membrane, the syringe or the row of a list that a path is in.
void grow(Scene& scene, std::string_view path) {
  if (const auto i = index_after(path, "membrane", max_membranes))
    while (scene.membranes.size() <= *i) scene.membranes.emplace_back();
  if (path.substr(0, 8) == "syringe." && !scene.syringe) scene.syringe.emplace();
  if (const auto close = path.rfind("]."); close != std::string_view::npos) {
    const std::string_view list = path.substr(0, path.rfind('[', close));
    if (const auto row = index_after(path, list, longest_list)) make_rows(scene, std::string(list), *row + 1);
  }
}

std::string_view trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(" \t\r"), last = text.find_last_not_of(" \t\r");
  return first == std::string_view::npos ? std::string_view() : text.substr(first, last - first + 1);
}

/// Calls f(path, value, line number) for each line that is neither empty nor a comment.
template <typename F>
void for_each_line(std::string_view text, F&& f) {
  int number = 0;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    const std::string_view line = trimmed(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
    ++number;
    if (line.empty() || line.front() == '#') continue;
    const std::size_t equals = std::min(line.find('='), line.size());
    f(std::string(trimmed(line.substr(0, equals))), trimmed(line.substr(std::min(equals + 1, line.size()))), number);
  }
}

void read_lines(std::string_view text, Scene& scene, std::vector<Problem>& problems) {
  for_each_line(text, [&](const std::string& path, std::string_view, int) { grow(scene, path); });
  std::map<std::string, double*> places;
  for_each_value(scene, [&](const std::string& path, const Field&, double& number) { places[path] = &number; });
  for_each_line(text, [&](const std::string& path, std::string_view value, int line) {
    const std::string where = "line " + std::to_string(line);
    if (!check_name(path, where, problems)) return;
    if (value.size() >= 2 && value.front() == '"' && value.back() == '"') {
      set_word(scene, path, value.substr(1, value.size() - 2), problems);
      return;
    }
    const auto place = places.find(path);
    const std::optional<double> number = read_decimal(value);
    if (place == places.end())
      problems.push_back({where, not_given, "the scene has no number \"" + path + "\""});
    else if (!number)
      problems.push_back({where, not_given, "must be PATH = NUMBER or PATH = \"WORD\""});
    else
      *place->second = *number;
  });
}

}  // namespace
}  // namespace punctura::c

using namespace punctura::c;

punctura_status punctura_scene_from_values(const char* text, size_t size, punctura_scene** scene) {
  return guarded([&] {
    if (!text || !scene) return null_pointer();
    auto made = std::make_unique<punctura_scene>(punctura_scene{});
    std::vector<punctura::Problem> problems;
    read_lines(std::string_view(text, size), made->scene, problems);
    if (problems.empty()) problems = check(made->scene);
    if (!problems.empty()) return fail(std::move(problems));
    *scene = made.release();
    return ok;
  });
}
