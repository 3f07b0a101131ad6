// Converts snapshots to columns, by the table of tick fields.
#include "tick_columns.hpp"

#include <algorithm>
#include <array>
#include <string>
#include <tuple>
#include <vector>

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

}  // namespace punctura::bindings
