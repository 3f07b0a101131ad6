// Scenes from the text of a scene file. The keys and units are those of the Python package (scene_keys.hpp).
#ifdef PUNCTURA_C_TOML
// toml++ 3.3 asserts what a wrong text does not hold, and lets the compiler assume it where NDEBUG is defined. The
// check that follows each assertion gives an error. tests/fuzz/c_abi_fuzz.cpp looks for texts where none follows.
#define TOML_EXCEPTIONS 0
#define TOML_ASSERT(condition) static_cast<void>(0)
#pragma push_macro("NDEBUG")
#undef NDEBUG
#include <toml++/toml.h>
#pragma pop_macro("NDEBUG")
#endif

#include <algorithm>
#include <charconv>
#include <map>
#include <memory>
#include <optional>

#include "punctura/model/decimal.hpp"
#include "punctura/scene/values.hpp"
#include "scene.hpp"
#include "scene_keys.hpp"
#include "scene_text.hpp"

#ifdef PUNCTURA_C_TOML

namespace punctura::c {
namespace {

/// Reads the tables of a file into a scene.
class Reader {
 public:
  Reader(const SceneText& text, Scene& scene, std::vector<Problem>& problems)
      : text_(text), scene_(scene), problems_(problems) {
    find_places();
  }

  /// kind: the table's name in scene_keys; path: with the number of a membrane.
  void table(const toml::table& from, std::string_view kind, const std::string& path) {
    const std::string dot = path.empty() ? "" : path + ".";
    for (const auto& [key, node] : from) {
      const SceneKey* known = nullptr;
      for (const SceneKey& row : scene_keys)
        if (row.table == kind && row.key == key.str()) known = &row;
      const std::string place = dot + (is_plain_text(key.str()) ? std::string(key.str()) : "a key");
      if (known)
        value(*known, node, dot, place);
      else if (!path.empty() || !node.is_table())
        problem(place, "scene files have no such key");
    }
    for (const SceneKey& row : scene_keys)
      if (row.table == kind && !row.has_default && !keys.contains(dot + std::string(row.name)))
        problem(dot + std::string(row.key), "is missing");
  }

  void problem(const std::string& path, const std::string& reason) { problems_.push_back({path, not_given, reason}); }

  std::map<std::string, std::string> keys;  ///< path in the core -> path in the file

 private:
  void value(const SceneKey& key, const toml::node& node, const std::string& dot, const std::string& place) {
    const std::string path = dot + std::string(key.name);
    if (const auto [first, fresh] = keys.try_emplace(path, place); !fresh)
      return problem(place, "is the same as " + first->second + ": give only one of them");
    const auto word = node.value<std::string>();
    if (key.kind == KeyKind::word && !word) return problem(place, "must be text, in quotes");
    if (key.kind == KeyKind::word || (key.kind == KeyKind::number_or_word && word))
      return void(set_word(scene_, path, *word, problems_));
    if (key.kind == KeyKind::gauge) return gauge(node, path, place);
    if (key.kind == KeyKind::vector) return vector(key, node, path, place);
    if (key.kind == KeyKind::column) return column(key, node, path, place);
    if (!node.is_number()) return problem(place, "must be a number");
    *places_.at(path) = in_si(node, key);
  }

  /// In SI units.
  double in_si(const toml::node& node, const SceneKey& key) const {
    const double value = *node.value<double>();
    return std::isfinite(value) ? scaled_decimal(text_.number(node), key.digits, key.exponent) : value;
  }

  void vector(const SceneKey& key, const toml::node& node, const std::string& path, const std::string& place) {
    const toml::array* numbers = node.as_array();
    const bool three = numbers && numbers->size() == 3 &&
                       std::all_of(numbers->begin(), numbers->end(), [](const auto& n) { return n.is_number(); });
    if (!three) return problem(place, "must be three numbers, [x, y, z]");
    for (std::size_t k = 0; k < 3; ++k)
      *places_.at(path + "[" + std::to_string(k) + "]") = in_si(*numbers->get(k), key);
  }

  /// A list of numbers: one field of each row of a list in the core. path: of the field, with [] for the row.
  void column(const SceneKey& key, const toml::node& node, const std::string& path, const std::string& place) {
    const toml::array* numbers = node.as_array();
    if (!numbers || !std::all_of(numbers->begin(), numbers->end(), [](const auto& n) { return n.is_number(); }))
      return problem(place, "must be a list of numbers");
    if (numbers->size() > longest_list)
      return problem(
          place, "has " + std::to_string(numbers->size()) + " numbers; the limit is " + std::to_string(longest_list));
    const std::size_t row = path.find("[]");
    make_rows(scene_, path.substr(0, row), numbers->size());
    find_places();
    for (std::size_t i = 0; i < numbers->size(); ++i) {
      const std::string number = "[" + std::to_string(i) + "]",
                        at = path.substr(0, row) + number + path.substr(row + 2);
      keys[at] = place + number;
      *places_.at(at) = in_si(*numbers->get(i), key);
    }
  }

  void find_places() {
    for_each_value(scene_, [&](const std::string& path, const Field&, double& number) { places_[path] = &number; });
  }

  void gauge(const toml::node& node, const std::string& path, const std::string& place) {
    const auto* given = node.as_integer();
    for (const GaugeDiameter& row : gauge_diameters)
      if (given && given->get() == row.gauge) *places_.at(path) = scaled_decimal("1", row.digits, row.exponent);
    if (!given || std::isnan(*places_.at(path))) problem(place, "must be a whole number from 10 to 34, ISO 9626");
  }

  const SceneText& text_;
  Scene& scene_;
  std::vector<Problem>& problems_;
  std::map<std::string, double*> places_;
};

/// A table of the file; nullptr, with a problem, if it is none or is missing.
const toml::table* table_at(const toml::table& file, std::string_view name, bool needed, Reader& reader) {
  const toml::node* node = file.get(name);
  if (!node && needed) reader.problem(std::string(name), "the table is missing");
  if (node && !node->is_table()) reader.problem(std::string(name), "must be a table, [" + std::string(name) + "]");
  return node ? node->as_table() : nullptr;
}

void read_file(const SceneText& text, const toml::table& file, Scene& scene, std::vector<Problem>& problems) {
  const toml::array* membranes = file.get("membrane") ? file.get("membrane")->as_array() : nullptr;
  if (membranes && membranes->size() > max_membranes)
    return problems.push_back({"membrane", static_cast<double>(membranes->size()), too_many_membranes});
  for (std::size_t i = 0; membranes && i < membranes->size(); ++i) scene.membranes.push_back(empty_membrane());
  scene.syringe = empty_syringe();  // so that for_each_value() visits all numbers
  Reader reader(text, scene, problems);
  toml::table rest = file;
  rest.erase("membrane");
  reader.table(rest, "", "");
  for (const auto& [key, node] : rest)
    if (const std::string_view name = key.str(); node.is_table() && name != "needle" && name != "coupling" &&
                                                 name != "servo" && name != "display" && name != "syringe")
      reader.problem(is_plain_text(name) ? std::string(name) : "a table", "scene files have no such table");
  for (const std::string name : {"needle", "coupling", "servo", "display"})
    if (const auto* table = table_at(file, name, name == "needle" || name == "coupling", reader))
      reader.table(*table, name, name);
  const toml::table* syringe = table_at(file, "syringe", false, reader);
  if (syringe) reader.table(*syringe, "syringe", "syringe");
  if (!membranes) reader.problem("membrane", "must be an array of tables, [[membrane]]");
  for (std::size_t i = 0; membranes && i < membranes->size(); ++i) {
    const std::string path = "membrane[" + std::to_string(i) + "]";
    if (const auto* table = membranes->get(i)->as_table())
      reader.table(*table, "membrane", path);
    else
      reader.problem(path, "must be a table, [[membrane]]");
  }
  if (!syringe) scene.syringe.reset();
  if (!problems.empty()) return;
  problems = check(scene);
  for (Problem& p : problems)
    if (const auto key = reader.keys.find(p.path); key != reader.keys.end()) p.path = key->second;
}

}  // namespace
}  // namespace punctura::c

using namespace punctura::c;

punctura_status punctura_scene_from_toml(const char* text, size_t size, punctura_scene** scene) {
  return guarded([&] {
    if (!text || !scene) return null_pointer();
    const SceneText lines(std::string_view(text, size));
    if (const auto beyond = lines.excess(); !beyond.empty()) return fail({{"text", not_given, beyond}});
    const toml::parse_result file = toml::parse(lines.all());
    if (!file) {
      const auto at = file.error().source().begin;
      const std::string path = "line " + std::to_string(at.line) + ", column " + std::to_string(at.column);
      return fail({{path, not_given, "this is not TOML: " + std::string(file.error().description())}});
    }
    auto made = std::make_unique<punctura_scene>(punctura_scene{empty_scene()});
    std::vector<punctura::Problem> problems;
    read_file(lines, file.table(), made->scene, problems);
    if (!problems.empty()) return fail(std::move(problems));
    *scene = made.release();
    return ok;
  });
}

#else

punctura_status punctura_scene_from_toml(const char*, size_t, punctura_scene**) {
  return punctura::c::fail(PUNCTURA_NOT_BUILT, punctura_status_text(PUNCTURA_NOT_BUILT));
}

#endif
