// The table of tick fields: as a list, and as the attributes of punctura.Ticks.
#include <nanobind/stl/optional.h>

#include "bindings.hpp"
#include "punctura/lab/plant/experiment_table.hpp"
#include "tick_store.hpp"
#include "value.hpp"

namespace punctura::bindings {
namespace {

/// One row of the table.
struct Field {
  std::string name, column, unit, says, dtype;
  std::size_t width;
  bool per_membrane, input, on_page;
  std::optional<std::vector<std::string>> words;

  /// For a docstring: "(n, 3), m. The needle's tip".
  std::string doc() const {
    const std::string shape =
        std::string("(n,") + (per_membrane ? " m" : "") + (width == 3 ? (per_membrane ? ", 3)" : " 3)") : ")");
    return shape + (unit.empty() ? "" : ", " + unit) + ". " + says;
  }
  std::string signature() const {
    const std::string type = dtype == "bool" ? "bool_" : dtype;
    return "def " + name + "(self) -> numpy.typing.NDArray[numpy." + type + "]";
  }
};

/// The names of an enumeration's values, by number; None for plain numbers.
template <typename Value>
std::optional<std::vector<std::string>> words_of() {
  if constexpr (std::is_enum_v<Value>) {
    std::vector<std::string> words;
    for (const nb::handle member : nb::type<Value>()) words.push_back(nb::cast<std::string>(member.attr("name")));
    return words;
  } else {
    return std::nullopt;
  }
}

std::vector<Field> fields() {
  std::vector<Field> all;
  for_each_field(experiment_table, [&](const auto& field, auto) {
    using Store = FieldStore<decltype(field), ExperimentExtra>;
    using Value = typename Store::Value;
    using Number = std::conditional_t<std::is_same_v<Value, bool>, bool, typename Store::Type>;
    all.push_back({field.name, field.column, field.unit, field.says, dtype_name<Number>(), Store::width,
                   field.per_membrane, (field.use & use_input) != 0, (field.use & use_page) != 0, words_of<Value>()});
  });
  return all;
}

/// The arrays of punctura.Ticks. The Python class adds the methods that do not need the core.
struct TickArrays {
  nb::dict columns;

  nb::object get(const std::string& name) const {
    if (columns.contains(name.c_str())) return columns[name.c_str()];
    std::string has;
    for (const auto& [key, _] : columns) has += (has.empty() ? "" : ", ") + nb::cast<std::string>(key);
    throw nb::attribute_error(("these ticks have no " + name + "; they have " + has).c_str());
  }
};

}  // namespace

void bind_tick_table(nb::module_& m) {
  auto field = nb::class_<Field>(m, "TickField", "One field of a tick, from the core's table.");
  field.def_ro("name", &Field::name, "Name of the attribute of Ticks")
      .def_ro("column", &Field::column, "Column name in a file: {a} is x, y or z, {i} the membrane's number")
      .def_ro("unit", &Field::unit, "Unit; empty for numbers without one")
      .def_ro("says", &Field::says, "Description")
      .def_ro("dtype", &Field::dtype, "NumPy name of the type")
      .def_ro("width", &Field::width, "Number of components: 1, or 3 for a vector")
      .def_ro("per_membrane", &Field::per_membrane, "Whether each membrane has its own value")
      .def_ro("input", &Field::input, "Whether it is an input, which a replay needs")
      .def_ro("on_page", &Field::on_page, "Whether the studio's page receives it")
      .def_ro("words", &Field::words, "The words for its codes; None for plain numbers");
  def_value(field, {"name", "column", "unit", "says", "dtype", "width", "per_membrane", "input", "on_page", "words"});

  const auto table = fields();
  m.def("tick_fields", &fields, "All fields of a tick, in the order of a file's columns.");

  auto arrays = nb::class_<TickArrays>(
      m, "TickArrays",
      "The columns of punctura.Ticks by name: n ticks, m membranes. A missing field raises AttributeError.");
  def_repr(arrays, "TickArrays({0.columns})");
  arrays
      .def(nb::init<nb::dict>(), nb::arg("columns"),
           nb::sig("def __init__(self, columns: dict[str, numpy.typing.NDArray[typing.Any]]) -> None"))
      .def_prop_ro(
          "columns", [](const TickArrays& self) { return self.columns; },
          nb::sig("def columns(self) -> dict[str, numpy.typing.NDArray[typing.Any]]"), "The arrays by name.");
  for (const Field& f : table) {
    const std::string signature = f.signature(), doc = f.doc();
    arrays.def_prop_ro(
        f.name.c_str(), [name = f.name](const TickArrays& self) { return self.get(name); }, nb::sig(signature.c_str()),
        doc.c_str());
  }
}

}  // namespace punctura::bindings
