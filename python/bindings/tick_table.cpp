// The table of tick fields: as a list, and as the attributes of punctura.Ticks.
#include <nanobind/stl/optional.h>

#include "bindings.hpp"
#include "punctura/lab/plant/experiment.hpp"
#include "struct.hpp"
#include "tick_columns.hpp"

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

constexpr std::tuple field_rows{
    row("name", &Field::name, "Name of the attribute of Ticks."),
    row("column", &Field::column, "Column name in a file: {a} is x, y or z, {i} the membrane's number."),
    row("unit", &Field::unit, "Unit; empty for numbers without one."),
    row("says", &Field::says, "Description."),
    row("dtype", &Field::dtype, "NumPy name of the type."),
    row("width", &Field::width, "Number of components: 1, or 3 for a vector."),
    row("per_membrane", &Field::per_membrane, "Whether each membrane has its own value."),
    row("input", &Field::input, "Whether it is an input, which a replay needs."),
    row("on_page", &Field::on_page, "Whether the studio's page receives it."),
    row("words", &Field::words, "The words for its codes; None for plain numbers."),
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
    using Store = FieldStore<decltype(field)>;
    using Value = typename Store::Value;
    using Number = std::conditional_t<std::is_same_v<Value, bool>, bool, typename Store::Type>;
    all.push_back({field.name, field.column, field.unit, field.says, dtype_name<Number>(), Store::width,
                   field.per_membrane, (field.use & use_input) != 0, (field.use & use_page) != 0, words_of<Value>()});
  });
  return all;
}

using Dict = nb::typed<nb::dict, std::string, Object<"numpy.typing.NDArray[typing.Any]">>;

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
  def_struct<field_rows>(m,
                         {.name = "TickField",
                          .doc = "One field of a tick, from the core's table.",
                          .raises = "tick_fields() creates these objects.",
                          .needed = 10},
                         unchecked);

  const auto table = fields();
  m.def("tick_fields", &fields, "All fields of a tick, in the order of a file's columns.");

  auto arrays = nb::class_<TickArrays>(
      m, "TickArrays",
      "The columns of punctura.Ticks by name: n ticks, m membranes. A missing field raises AttributeError.");
  def_repr(arrays, "TickArrays({0.columns})");
  arrays.def(nb::init<Dict>(), nb::arg("columns"))
      .def_prop_ro("columns", [](const TickArrays& self) { return Dict(self.columns); }, "The arrays by name.");
  for (const Field& f : table) {
    const std::string signature = f.signature(), doc = f.doc();
    arrays.def_prop_ro(
        f.name.c_str(), [name = f.name](const TickArrays& self) { return self.get(name); }, nb::sig(signature.c_str()),
        doc.c_str());
  }
}

}  // namespace punctura::bindings
