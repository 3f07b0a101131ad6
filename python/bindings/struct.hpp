// The class of a plain struct in Python, from one table of its members. For a struct of a scene that is the core's
// table: a new row there is a new argument, property and part of a pickle here.
#pragma once

#include <nanobind/stl/optional.h>
#include <nanobind/stl/tuple.h>

#include <bit>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

#include "bindings.hpp"
#include "punctura/model/field.hpp"
#include "value.hpp"

namespace punctura::bindings {

/// The type of a member in Python: what a constructor takes and makes the member `from`, and what a property has shown.
template <typename Value>
struct InPython {
  using Given = Value;
  static Value from(Given given, const std::string&) { return given; }
  static const Value& shown(const Value& value) { return value; }
};
template <typename Enum>
  requires std::is_enum_v<Enum>
struct InPython<Enum> {
  using Given = Word<Enum>;
  static Enum from(const Given& given, const std::string& path) { return given.at(path); }
  static Given shown(Enum value) { return value; }
};
template <std::size_t n>
struct InPython<std::array<double, n>> {
  using Given = std::array<double, n>;
  static Given from(const Given& given, const std::string&) { return given; }
  static auto shown(const Given& value) { return std::tuple_cat(value); }
};
template <>
struct InPython<std::span<const std::string_view>> {
  static auto shown(std::span<const std::string_view> words) {
    return std::vector<std::string>(words.begin(), words.end());
  }
};
template <>
struct InPython<Vector3d> {
  using Given = Triple;
  static Vector3d from(const Given& given, const std::string&) { return to_vector(given); }
  static auto shown(const Vector3d& value) { return std::tuple_cat(to_array(value)); }
};
template <typename Entry>
struct InPython<std::vector<Entry>> {
  using Given = std::vector<Entry>;
  static Given from(Given given, const std::string&) { return given; }
  static auto shown(const Given& value) { return shown_tuple(value); }
};

/// A row for a struct that has no table in the core.
template <typename Owner, typename Value>
constexpr FieldOf<Owner, Value> row(const char* name, Value Owner::* member, std::string_view help = {}) {
  return {{name, "", "", {}, help}, member};
}

/// The rows of a table as a tuple.
template <typename Owner, std::size_t n>
constexpr auto as_rows(const FieldOf<Owner> (&rows)[n]) {
  return [&]<std::size_t... i>(std::index_sequence<i...>) {
    return std::make_tuple(rows[i]...);
  }(std::make_index_sequence<n>());
}
template <typename... Row>
constexpr std::tuple<Row...> as_rows(const std::tuple<Row...>& rows) {
  return rows;
}

/// "kappa, N/m. Resistance of the hole to widening."
inline std::string doc_of(const Field& field) {
  std::string doc;
  for (const auto& part : {field.symbol, field.unit})
    if (!part.empty() && part != "-") doc += (doc.empty() ? "" : ", ") + std::string(part);
  return doc + (doc.empty() || field.help.empty() ? "" : ". ") + std::string(field.help);
}

/// The argument for the member of a row, with the default of the struct.
template <typename Owner, typename Value>
nb::arg_v argument(const FieldOf<Owner, Value>& row, const Owner& standard, bool needed) {
  return {nb::arg(row.name.data()), needed ? nb::object() : nb::cast(InPython<Value>::shown(standard.*row.member))};
}

/// A read-only property for the member of a row. part: of an object T, has the member; T derives from Owner by default.
template <typename T, typename Owner, typename Value, typename Part = std::identity>
void def_member(nb::class_<T>& cls, const FieldOf<Owner, Value>& row, Part part = {}) {
  const auto get = [member = row.member, part](const T& object) -> decltype(auto) {
    const Owner& owner = std::invoke(part, object);
    return InPython<Value>::shown(owner.*member);
  };
  cls.def_prop_ro(row.name.data(), get, doc_of(row).c_str());
}

/// What a class says of itself and of its constructor.
struct ClassTexts {
  const char* name = nullptr;
  const char* doc = nullptr;
  std::string path = "";  ///< of problems
  const char* raises = "Raises ConfigurationError.";
  int needed = -1;  ///< number of arguments without a default; -1: all up to the last number that is NaN by default
};

/// Checks each number alone.
struct CheckNumbers {};
inline constexpr auto unchecked = [](const auto&, std::vector<Problem>&) {};

/// A struct T of these rows: an array or a tuple of FieldOf, with static storage.
template <const auto& rows, typename Table = decltype(as_rows(rows)),
          typename Index = std::make_index_sequence<std::tuple_size_v<Table>>>
class StructOf;

template <const auto& rows, typename T, typename... Value, std::size_t... i>
class StructOf<rows, std::tuple<FieldOf<T, Value>...>, std::index_sequence<i...>> {
 public:
  using Struct = T;

  /// Defines the class of a Made that derives from T. Each row is an argument of its constructor and a read-only
  /// property.
  template <typename Made, typename Check, typename... Extra>
  static nb::class_<Made> define(nb::module_& m, const ClassTexts& texts, Check check, const Extra&... extra) {
    auto cls = nb::class_<Made>(m, texts.name, texts.doc);
    def_init(cls, texts, check, extra...);
    for_each([&](const auto& row) { def_member(cls, row); });
    return cls;
  }
  /// Defines the constructor of a class Made that is made from a T.
  ///
  /// check(made, problems) adds the problems that the constructor raises. extra: of the constructor: nb::kw_only().
  template <typename Made, typename Check, typename... Extra>
  static void def_init(nb::class_<Made>& cls, const ClassTexts& texts, Check check, const Extra&... extra) {
    const T standard{};
    int needed = texts.needed;
    std::string doc;
    for_each([&, n = 0](const auto& row) mutable {
      ++n;
      if constexpr (is_number<decltype(row)>)
        if (texts.needed < 0 && std::isnan(standard.*row.member)) needed = n;
      const std::string says = doc_of(row);
      if (!says.empty()) doc += std::string(row.name) + ": " + says + (says.back() == '.' ? "\n" : ".\n");
    });
    cls.def(
        "__init__",
        [path = texts.path, check](Made* self, typename InPython<Value>::Given... given) {
          T made{};
          const std::string dot = path.empty() ? "" : path + ".";
          ((made.*std::get<i>(table).member =
                InPython<Value>::from(std::move(given), dot + std::string(std::get<i>(table).name))),
           ...);
          std::vector<Problem> problems;
          const auto on_number = [&](const auto& act) {
            for_each([&](const auto& row) {
              if constexpr (is_number<decltype(row)>) act(row, made.*row.member);
            });
          };
          if constexpr (std::is_same_v<Check, CheckNumbers>)
            on_number([&](const Field& row, double value) { check_field(row, value, path, problems); });
          else
            check(made, problems);
          raise_if(problems);
          on_number([&](const Field& row, double value) {
            if (row.usual.high < no_bound) warn_unusual(dot + std::string(row.name), value);
          });
          new (self) Made(std::move(made));
        },
        extra..., argument(std::get<i>(table), standard, static_cast<int>(i) < needed)...,
        (doc + texts.raises).c_str());
  }
  static nb::tuple arguments(const T& given) {
    return nb::make_tuple(InPython<Value>::shown(given.*std::get<i>(table).member)...);
  }
  static std::vector<const char*> names() { return {std::get<i>(table).name.data()...}; }

 private:
  static constexpr auto table = as_rows(rows);
  template <typename Row>
  static constexpr bool is_number = std::is_same_v<Row, const FieldOf<T>&>;

  template <typename Visit>
  static void for_each(Visit&& visit) {
    (visit(std::get<i>(table)), ...);
  }
};

/// Defines the class of a struct as an immutable value: StructOf<rows>::define and def_value.
template <const auto& rows, typename Made = typename StructOf<rows>::Struct, typename Check = CheckNumbers>
auto def_struct(nb::module_& m, const ClassTexts& texts, Check check = {}) {
  auto cls = StructOf<rows>::template define<Made>(m, texts, check);
  def_value(cls, StructOf<rows>::names());
  return cls;
}

}  // namespace punctura::bindings

/// A struct of numbers as a tuple of them, in a list of rows. Derive its caster from this.
namespace nanobind::detail {
template <typename Row>
struct row_caster {
  using Numbers = std::array<double, sizeof(Row) / sizeof(double)>;
  using Tuple = decltype(std::tuple_cat(Numbers()));
  NB_TYPE_CASTER(Row, make_caster<Tuple>::Name)

  bool from_python(handle given, std::uint32_t flags, cleanup_list* cleanup) noexcept {
    make_caster<Numbers> numbers;
    const bool good = numbers.from_python(given, flags, cleanup);
    if (good) value = std::bit_cast<Row>(numbers.value);
    return good;
  }
  static handle from_cpp(const Row& row, rv_policy policy, cleanup_list* cleanup) noexcept {
    return make_caster<Tuple>::from_cpp(std::tuple_cat(std::bit_cast<Numbers>(row)), policy, cleanup);
  }
};
}  // namespace nanobind::detail
