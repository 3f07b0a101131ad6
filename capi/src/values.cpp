// Scenes from lines "path = value" in SI units. Needs no TOML reader: an FMU carries its scene in this form.
#include <algorithm>
#include <optional>
#include <string>

#include "common.hpp"
#include "punctura/model/decimal.hpp"
#include "punctura/scene/by_path.hpp"

namespace punctura::c {
namespace {

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
  for_each_line(text, [&](const std::string& path, std::string_view, int) { make_room(scene, path); });
  const ScenePlaces places(scene);
  for_each_line(text, [&](const std::string& path, std::string_view value, int line) {
    const std::string where = "line " + std::to_string(line);
    if (!check_name(path, where, problems)) return;
    if (value.size() >= 2 && value.front() == '"' && value.back() == '"') {
      places.set(path, value.substr(1, value.size() - 2), problems);
      return;
    }
    double* const place = places.number(path);
    const std::optional<double> number = read_decimal(value);
    if (!place)
      problems.push_back(
          {where, not_given, "the scene has no number \"" + path + "\"" + did_you_mean(path, places.numbers())});
    else if (!number)
      problems.push_back({where, not_given, "must be PATH = NUMBER or PATH = \"WORD\""});
    else
      *place = *number;
  });
  if (problems.empty()) problems = check(scene);
}

}  // namespace
}  // namespace punctura::c

punctura_status punctura_scene_from_values(const char* text, size_t size, punctura_scene** scene) {
  return punctura::c::scene_from(text, size, 4096 * 1024, scene, punctura::c::read_lines);
}
