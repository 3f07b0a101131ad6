// The table of tick fields: as a list, as the attributes of punctura.Ticks, and to convert snapshots to columns.

#include <algorithm>
#include <array>
#include <string>
#include <tuple>
#include <vector>

#include <nanobind/stl/optional.h>

#include "bindings.hpp"
#include "punctura/lab/plant/experiment.hpp"
#include "struct.hpp"
#include "tick_columns.hpp"

namespace punctura::bindings {
struct TickColumns::Columns {
  std::array<bool, std::tuple_size_v<decltype(experiment_table)>> wanted{};
  ColumnsOf<decltype(experiment_table)> columns{};
  std::size_t rows = 0, most = 0;

  template <typename Do>
  void each(Do&& act) {
    for_each_field(experiment_table, [&](const auto& field, auto i) {
      if (wanted[i]) act(field, std::get<i>(columns));
    });
  }

  /// For a scene with more membranes: earlier rows get absent values for the new ones.
  void widen(std::size_t membranes) {
    each([&](const auto& field, auto& column) {
      using Put = FieldStore<decltype(field)>;
      if constexpr (std::remove_cvref_t<decltype(field)>::per_membrane) {
        std::remove_reference_t<decltype(column)> wide(rows * membranes * Put::width, absent<typename Put::Type>());
        for (std::size_t row = 0; row < rows; ++row)
          std::copy_n(&column[row * most * Put::width], most * Put::width, &wide[row * membranes * Put::width]);
        column = std::move(wide);
      }
    });
    most = membranes;
  }
};

TickColumns::TickColumns(const std::vector<std::string_view>& only, bool with_extra) : columns_(new Columns) {
  for_each_field(experiment_table, [&](const auto& field, auto i) {
    constexpr bool is_extra = is_of<ExperimentExtra, decltype(field)>;
    const bool named = only.size() == 0 || std::find(only.begin(), only.end(), field.name) != only.end();
    columns_->wanted[i] = is_extra ? with_extra : named;
  });
}

TickColumns::~TickColumns() = default;

void TickColumns::reserve(std::size_t rows, std::size_t membranes) {
  columns_->most = std::max(columns_->most, membranes);
  const auto numbers_of = [&](const auto& field) {
    return rows * (field.per_membrane ? membranes : 1) * FieldStore<decltype(field)>::width;
  };
  double bytes = 0;
  columns_->each(
      [&](const auto& field, auto& column) { bytes += static_cast<double>(numbers_of(field)) * sizeof(column[0]); });
  enough_memory(bytes, "the columns of " + std::to_string(rows) + " ticks", "Make the run in parts.");
  columns_->each([&](const auto& field, auto& column) { column.reserve(numbers_of(field)); });
}

void TickColumns::add(const Snapshot& record, const ExperimentExtra& extra) {
  if (record.membrane_count > columns_->most) columns_->widen(record.membrane_count);
  columns_->each([&, most = columns_->most](const auto& field, auto& column) {
    using Put = FieldStore<decltype(field)>;
    const std::size_t at = column.size();
    if constexpr (std::remove_cvref_t<decltype(field)>::per_membrane) {
      column.resize(at + most * Put::width, absent<typename Put::Type>());
      for (std::size_t m = 0; m < record.membrane_count; ++m)
        Put::put(&column[at + m * Put::width], field.get(record.membranes[m]));
    } else {
      column.resize(at + Put::width);
      if constexpr (is_of<ExperimentExtra, decltype(field)>)
        Put::put(&column[at], field.get(extra));
      else
        Put::put(&column[at], field.get(record));
    }
  });
  ++columns_->rows;
}

TicksObject TickColumns::to_ticks(std::size_t components, bool single) {
  nb::dict columns;
  columns_->each([&](const auto& field, auto& column) {
    using Put = FieldStore<decltype(field)>;
    std::vector<std::size_t> shape{columns_->rows};
    if (field.per_membrane && !single) shape.push_back(columns_->most);
    if constexpr (Put::width == 3) {
      if (components == 1) {
        for (std::size_t i = 0; 3 * i < column.size(); ++i) column[i] = column[3 * i];
        column.resize(column.size() / 3);
      } else {
        shape.push_back(3);
      }
    }
    nb::object array = to_numpy(std::move(column), shape);
    if constexpr (std::is_same_v<typename Put::Value, bool>) array = array.attr("view")("bool");
    columns[field.name] = std::move(array);
  });
  return nb::module_::import_("punctura.ticks").attr("Ticks")(columns);
}

namespace {

struct Field {
  std::string name, column, unit, help, dtype;
  std::size_t width;
  bool per_membrane, input, on_page;
  std::optional<std::vector<std::string>> words;

  /// For a docstring: "(n, 3), m. The needle's tip".
  std::string doc() const {
    const std::string shape =
        std::string("(n,") + (per_membrane ? " m" : "") + (width == 3 ? (per_membrane ? ", 3)" : " 3)") : ")");
    return shape + (unit.empty() ? "" : ", " + unit) + ". " + help;
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
    row("help", &Field::help, "What it is."),
    row("dtype", &Field::dtype, "NumPy name of the type."),
    row("width", &Field::width, "Number of components: 1, or 3 for a vector."),
    row("per_membrane", &Field::per_membrane, "Whether each membrane has its own value."),
    row("input", &Field::input, "Whether it is an input, which a replay needs."),
    row("on_page", &Field::on_page, "Whether the studio's page receives it."),
    row("words", &Field::words, "The words for its codes; None for plain numbers."),
};

/// The words of an enumeration's values, by number; None for plain numbers.
template <typename Value>
std::optional<std::vector<std::string>> words_for() {
  if constexpr (std::is_enum_v<Value>)
    return std::vector<std::string>(words_of<Value>.begin(), words_of<Value>.end());
  else
    return std::nullopt;
}

std::vector<Field> fields() {
  std::vector<Field> all;
  for_each_field(experiment_table, [&](const auto& field, auto) {
    using Store = FieldStore<decltype(field)>;
    using Value = typename Store::Value;
    using Number = std::conditional_t<std::is_same_v<Value, bool>, bool, typename Store::Type>;
    all.push_back({field.name, field.column, field.unit, field.help, dtype_name<Number>(), Store::width,
                   field.per_membrane, (field.use & use_input) != 0, (field.use & use_page) != 0, words_for<Value>()});
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
