// The keys of a scene file, from the tables of a scene's fields: what readers, writers, schemas and forms follow.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "punctura/scene/values.hpp"

namespace punctura {

/// A table of a scene file; the first is the file itself.
struct SceneTable {
  std::string_view name, title, help;
  bool required;
};
inline constexpr SceneTable scene_tables[] = {
    {"", "Scene file", "A scene: a needle, the coupling that drives it, and the membranes.", true},
    {"needle", "Needle", "The needle: a wedge of one slanted face, then a shaft (K06 Fig. 1).", true},
    {"coupling", "Coupling",
     "The virtual spring and damper between device and proxy, one pair per membrane (K06 (21)).", true},
    {"servo", "Servo", "The rate and the method of the force computation.", false},
    {"display", "Display", "How a device shows forces that it cannot give.", false},
    {"syringe", "Syringe", "The syringe on the needle. It has no effect on the force on the needle.", false},
    {"membrane", "Membrane", "A membrane: a layer that grips the needle with dry friction (K06 section 2).", true},
};

/// What a key holds. A column is one field of each row of a list.
enum class KeyKind : std::uint8_t { number, number_or_word, vector, column, word, text, gauge };
template <>
inline constexpr std::array<std::string_view, 7> words_of<KeyKind>{"number", "number_or_word", "vector", "column",
                                                                   "word",   "text",           "gauge"};

/// A key of a scene file. A value in SI is the number in the file times the size of field.file.
struct SceneKey {
  std::string_view table;
  std::string key;
  std::string name;  ///< in the core; a column has [] in place of the row: "profile[].depth"
  KeyKind kind;
  Field field;
  std::span<const std::string_view> words{};  ///< of a word
  double number = not_given;                  ///< the default of a number
  std::string_view word{};                    ///< the default of a word
  std::string_view group{};                   ///< the part of a form that holds it and is closed at first
  std::string_view instead_of{};              ///< the name of the other key: a file has exactly one of the two
  bool sparse = false;                        ///< a file has it only where it differs from its default

  /// Whether every file needs this key, or the one that can stand instead of it.
  bool required() const noexcept {
    return kind == KeyKind::column || kind == KeyKind::word ? false : std::isnan(number);
  }
};

/// The value of `automatic`: see DisplaySettings.
inline constexpr std::string_view automatic_word = "automatic";

/// A needle's gauge and its outer diameter, m. ISO 9626:2016, Table 1: designated metric size
struct GaugeDiameter {
  int gauge;
  double diameter;
};
inline constexpr GaugeDiameter gauge_diameters[] = {
    {10, 3.4e-3},  {11, 3.0e-3},  {12, 2.7e-3},  {13, 2.4e-3},  {14, 2.1e-3},  {15, 1.8e-3},  {16, 1.6e-3},
    {17, 1.4e-3},  {18, 1.2e-3},  {19, 1.1e-3},  {20, 0.9e-3},  {21, 0.8e-3},  {22, 0.7e-3},  {23, 0.6e-3},
    {24, 0.55e-3}, {25, 0.5e-3},  {26, 0.45e-3}, {27, 0.4e-3},  {28, 0.36e-3}, {29, 0.33e-3}, {30, 0.3e-3},
    {31, 0.25e-3}, {32, 0.23e-3}, {33, 0.2e-3},  {34, 0.18e-3},
};

/// Other ways to give a field of the needle.
inline constexpr Field gauge_field{
    "gauge", "w", "", {}, "The outer diameter as a gauge of ISO 9626, instead of diameter_mm."};
inline constexpr Field degrees_field{"tip_angle",
                                     "theta",
                                     "rad",
                                     field_of(needle_fields, &Needle::tip_angle).range,
                                     "The tip angle in degrees, instead of radians.",
                                     in_unit("deg")};

/// A name as a title: "Tail floor" for "tail_floor".
inline std::string title_of(const Field& field) {
  std::string title(field.title.empty() ? field.name : field.title);
  std::replace(title.begin(), title.end(), '_', ' ');
  if (title[0] >= 'a' && title[0] <= 'z') title[0] = static_cast<char>(title[0] - 'a' + 'A');
  return title;
}

namespace detail {
inline std::string key_of(const Field& field, const std::string& before = "") {
  const std::string key = before + std::string(field.key_name.empty() ? field.name : field.key_name);
  return field.file.suffix.empty() ? key : key + "_" + std::string(field.file.suffix);
}

/// Whether a file has the row's key only where it differs from its default: what is not in K06's own model.
template <typename Owner, typename Value>
constexpr bool is_sparse(const FieldOf<Owner, Value>&) noexcept {
  return std::is_same_v<Owner, Tissue> || std::is_same_v<Owner, Outlet> || std::is_same_v<Owner, DisplaySettings>;
}
template <typename Owner, typename Value>
constexpr std::string_view group_of(const FieldOf<Owner, Value>&) noexcept {
  return std::is_same_v<Owner, Tissue> ? "Measured tissue" : "";
}
}  // namespace detail

/// All keys of a scene file, in the order of the file: one for each field of a scene, for each column of a list, and
/// the needle's other ways.
inline std::vector<SceneKey> scene_keys() {
  Scene defaults;
  defaults.syringe.emplace();
  defaults.membranes.emplace_back();
  std::vector<SceneKey> keys;
  visit_scene(std::as_const(defaults), [&](std::string_view path, const auto& row, const auto& value) {
    using Value = std::remove_cvref_t<decltype(value)>;
    const auto dot = std::min(path.find('.'), path.size());
    std::string_view table = dot == path.size() ? "" : path.substr(0, path.find_first_of("[."));
    for (const SceneTable& known : scene_tables)  // its text outlives the path
      if (known.name == table) table = known.name;
    SceneKey key{table, detail::key_of(row), std::string(row.name), KeyKind::number, row};
    key.group = detail::group_of(row);
    key.sparse = detail::is_sparse(row);
    if constexpr (std::is_same_v<Value, double>) {
      key.number = value;
      if (std::is_same_v<decltype(row), const FieldOf<DisplaySettings>&>) key.kind = KeyKind::number_or_word;
    } else if constexpr (std::is_same_v<Value, std::array<double, 3>>) {
      key.kind = KeyKind::vector;
    } else if constexpr (std::is_same_v<Value, std::string>) {
      key.kind = KeyKind::text;
    } else if constexpr (std::is_enum_v<Value>) {
      key.kind = KeyKind::word;
      key.words = words_of<Value>;
      key.word = word_of(value);
    } else {
      const std::string before(row.key_name.empty() ? row.name : row.key_name);
      for (const auto& column : columns_of<typename Value::value_type>) {
        SceneKey one = key;
        one.key = detail::key_of(column, before + "_");
        one.name = std::string(row.name) + "[]." + std::string(column.name);
        one.kind = KeyKind::column;
        one.field = column;
        keys.push_back(one);
      }
      return;
    }
    keys.push_back(key);
    if (row.name == "diameter" || row.name == "tip_angle") {
      const Field& other = row.name == "diameter" ? gauge_field : degrees_field;
      SceneKey instead{table, detail::key_of(other), key.name, key.kind, other};
      if (row.name == "diameter") instead.kind = KeyKind::gauge;
      instead.instead_of = row.name;
      keys.push_back(instead);
    }
  });
  return keys;
}

}  // namespace punctura
