// A row of the tables of fields: what checks, scene files, forms, documents and the bindings need to know of a field.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <iterator>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>

namespace punctura {

/// A word for each enumerator, in their order. Specialized beside each enumeration that a scene file can hold.
template <typename Enum>
inline constexpr std::array<std::string_view, 0> words_of{};

template <typename Enum>
constexpr std::string_view word_of(Enum value) noexcept {
  return words_of<Enum>[static_cast<std::size_t>(value)];
}

/// The enumerator with this word; empty if there is none.
template <typename Enum>
constexpr std::optional<Enum> enum_of(std::string_view word) noexcept {
  for (std::size_t i = 0; i < words_of<Enum>.size(); ++i)
    if (words_of<Enum>[i] == word) return static_cast<Enum>(i);
  return std::nullopt;
}

/// For a problem: one of "a", "b".
template <typename Enum>
std::string one_of() {
  std::string text = "one of";
  for (const auto word : words_of<Enum>)
    text += (word == words_of<Enum>.front() ? " \"" : ", \"") + std::string(word) + "\"";
  return text;
}

inline constexpr double no_bound = std::numeric_limits<double>::infinity();

/// A number that is not given, not known, or of something that is not there. No range holds it, so check() reports it.
inline constexpr double not_given = std::numeric_limits<double>::quiet_NaN();

/// The permitted range of one field, SI. Schemas, documents and bound_text() read the bounds from here.
struct Range {
  double min = -no_bound;
  double max = no_bound;
  bool min_open = false, max_open = false;
  const char* why = "";     ///< the end of the sentence: ": no device counts coarser"
  const char* at_min = "";  ///< what the lower bound means

  bool holds(double v) const noexcept {
    return std::isfinite(v) && (min_open ? v > min : v >= min) && (max_open ? v < max : v <= max);
  }
};

inline constexpr Range greater_than_0{0, no_bound, true, true};
inline constexpr Range at_least_0{0, no_bound, false, true};

/// A unit of files: the end of a key, as in thickness_mm, its name, and its size in SI: digits times 10^exponent.
struct FileUnit {
  std::string_view suffix{};
  std::string_view name{};
  std::string_view digits = "1";
  int exponent = 0;
};

/// All units of files. A longer suffix stands before one that is its end.
inline constexpr FileUnit file_units[] = {
    {"kPa_s_per_mL", "kPa s/mL", "1", 9},
    {"mL_per_kPa", "mL/kPa", "1", -9},
    {"Ns_per_mm", "N s/mm", "1", 3},
    {"N_per_mm", "N/mm", "1", 3},
    {"per_mm", "1/mm", "1", 3},
    {"m_per_s", "m/s"},
    {"rad", "rad"},
    // pi/180 with more digits than a double, so that an angle is rounded only once
    {"deg", "deg", "17453292519943295769236907684886127134428718885417", -51},
    {"kPa", "kPa", "1", 3},
    {"mm", "mm", "1", -3},
    {"mL", "mL", "1", -6},
    {"ms", "ms", "1", -3},
    {"hz", "Hz"},
    {"N", "N"},
    {"s", "s"},
};

/// The unit with this suffix; "" is a number without a unit. Another suffix does not compile.
consteval FileUnit in_unit(std::string_view suffix) {
  if (suffix.empty()) return {};
  for (const FileUnit& unit : file_units)
    if (unit.suffix == suffix) return unit;
  std::abort();
}

/// The usual sizes of a number, SI. A number outside them that fits in another unit was probably meant in that one.
struct UsualRange {
  double low = 0, high = no_bound;
};

/// A field: its name, its symbol in K06, its unit and range in SI, and what files and forms say of it. Its default is
/// the value that its struct has at first; a number that is not_given there must be given.
struct Field {
  std::string_view name, symbol, unit;
  Range range{};
  std::string_view help{};  ///< a sentence for users
  FileUnit file{};          ///< of its key in a scene file
  UsualRange usual{};
  std::string_view title{};     ///< in a form, where it is not the name
  std::string_view key_name{};  ///< in a key of a scene file, where it is not the name
};

/// A field of a struct: the field, and a pointer to the member. Value: double for a number, an enumeration with
/// words_of, or another member.
template <typename Owner, typename Value = double>
struct FieldOf : Field {
  Value Owner::* member = nullptr;
};

/// The fields of a row of a list, specialized beside each such struct. A scene file has a list for each.
template <typename Row>
inline constexpr std::nullptr_t columns_of{};

/// Calls visit(row) for each row of a table: an array of numbers, or a tuple with members of other types.
template <typename Rows, typename Visit>
constexpr void for_each_row(const Rows& rows, Visit&& visit) {
  if constexpr (requires { std::begin(rows); })
    for (const auto& row : rows) visit(row);
  else
    std::apply([&](const auto&... row) { (visit(row), ...); }, rows);
}

/// The numbers of a table with members of several types.
template <typename Number = double, typename Owner, typename... Value>
constexpr auto numbers_of(const std::tuple<FieldOf<Owner, Value>...>& rows) {
  std::array<FieldOf<Owner, Number>, (std::size_t{std::is_same_v<Value, Number>} + ...)> numbers;
  std::size_t n = 0;
  for_each_row(rows, [&](const auto& row) {
    if constexpr (std::is_same_v<decltype(row), const FieldOf<Owner, Number>&>) numbers[n++] = row;
  });
  return numbers;
}

/// The field of a member. A member that is not in the table does not compile.
template <typename Rows, typename Owner>
consteval const FieldOf<Owner>& field_of(const Rows& rows, double Owner::* member) {
  for (const auto& field : rows)
    if (field.member == member) return field;
  std::abort();
}

}  // namespace punctura
