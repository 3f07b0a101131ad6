// Converts snapshots to columns, by the table of tick fields.
#pragma once

#include <algorithm>
#include <array>
#include <limits>
#include <new>
#include <string>
#include <string_view>
#include <tuple>
#include <variant>
#include <vector>

#include "bindings.hpp"
#include "punctura/servo/tick_table.hpp"

namespace punctura::bindings {

/// The NumPy type of a field's numbers.
template <typename Value>
struct Stored {
  using Type = std::conditional_t<std::is_enum_v<Value> || std::is_same_v<Value, bool>, std::uint8_t, Value>;
  static constexpr std::size_t width = 1;
  static void put(Type* at, Value value) noexcept { *at = static_cast<Type>(value); }
};
template <>
struct Stored<Triple> {
  using Type = double;
  static constexpr std::size_t width = 3;
  static void put(double* at, const Triple& value) noexcept { std::copy(value.begin(), value.end(), at); }
};

/// The struct that holds a field, and the stored type.
template <typename Field, typename Extra = std::monostate>
using PartOf =
    std::conditional_t<std::remove_cvref_t<Field>::part == TickPart::membrane, MembraneRecord,
                       std::conditional_t<std::remove_cvref_t<Field>::part == TickPart::extra, Extra, Snapshot>>;
template <typename Field, typename Extra = std::monostate>
struct FieldStore : Stored<typename std::remove_cvref_t<Field>::template Value<PartOf<Field, Extra>>> {
  using Value = typename std::remove_cvref_t<Field>::template Value<PartOf<Field, Extra>>;
};

/// One std::vector for each field of a table.
template <typename Table, typename Extra>
struct ColumnsOfTable;
template <typename... Fields, typename Extra>
struct ColumnsOfTable<std::tuple<Fields...>, Extra> {
  using Type = std::tuple<std::vector<typename FieldStore<Fields, Extra>::Type>...>;
};
template <typename Table, typename Extra = std::monostate>
using ColumnsOf = typename ColumnsOfTable<std::remove_const_t<Table>, Extra>::Type;

/// The NumPy name of a type.
template <typename T>
std::string dtype_name() {
  if constexpr (std::is_same_v<T, bool>) return "bool";
  return (std::is_floating_point_v<T> ? "float" : "uint") + std::to_string(8 * sizeof(T));
}

/// Value in a membrane's column for ticks whose scene does not have that membrane.
template <typename T>
constexpr T absent() noexcept {
  if constexpr (std::is_floating_point_v<T>)
    return std::numeric_limits<T>::quiet_NaN();
  else
    return std::numeric_limits<T>::max();
}

/// Python gets it as a MemoryError.
class NoRoom : public std::bad_alloc {
 public:
  explicit NoRoom(std::size_t rows)
      : text_("not enough memory for the columns of " + std::to_string(rows) + " ticks: make the run in parts") {}
  const char* what() const noexcept override { return text_.c_str(); }

 private:
  std::string text_;
};

/// Collects snapshots without the GIL, then returns a punctura.Ticks with one row per snapshot.
template <typename Table, typename Extra = std::monostate>
class TickColumns {
 public:
  /// only: names of the fields to keep; empty for all.
  explicit TickColumns(const Table& table, std::initializer_list<std::string_view> only = {}) : table_(table) {
    for_each_field(table_, [&](const auto& field, auto i) {
      wanted_[i] = only.size() == 0 || std::find(only.begin(), only.end(), field.name) != only.end();
    });
  }
  void reserve(std::size_t rows, std::size_t membranes = 0) {
    most_ = std::max(most_, membranes);
    try {
      each([&](const auto& field, auto& column) {
        column.reserve(rows * (field.per_membrane ? membranes : 1) * FieldStore<decltype(field), Extra>::width);
      });
    } catch (const std::exception&) {  // std::bad_alloc or std::length_error
      throw NoRoom(rows);
    }
  }

  void add(const Snapshot& record, const Extra& extra = {}) {
    if (record.membrane_count > most_) widen(record.membrane_count);
    each([&](const auto& field, auto& column) {
      using Put = FieldStore<decltype(field), Extra>;
      const std::size_t at = column.size();
      if constexpr (std::remove_cvref_t<decltype(field)>::per_membrane) {
        column.resize(at + most_ * Put::width, absent<typename Put::Type>());
        for (std::size_t m = 0; m < record.membrane_count; ++m)
          Put::put(&column[at + m * Put::width], field.get(record.membranes[m]));
      } else {
        column.resize(at + Put::width);
        if constexpr (std::remove_cvref_t<decltype(field)>::part == TickPart::extra)
          Put::put(&column[at], field.get(extra));
        else
          Put::put(&column[at], field.get(record));
      }
    });
    ++rows_;
  }

  /// components: of a vector, 3, or 1 on a line. single: one membrane; the arrays have no axis for membranes.
  nb::object to_ticks(std::size_t components = 3, bool single = false) {
    nb::dict columns;
    each([&](const auto& field, auto& column) {
      using Put = FieldStore<decltype(field), Extra>;
      std::vector<std::size_t> shape{rows_};
      if (field.per_membrane && !single) shape.push_back(most_);
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

 private:
  template <typename Do>
  void each(Do&& act) {
    for_each_field(table_, [&](const auto& field, auto i) {
      if (wanted_[i]) act(field, std::get<i>(columns_));
    });
  }

  /// For a scene with more membranes: earlier rows get absent values for the new ones.
  void widen(std::size_t membranes) {
    each([&](const auto& field, auto& column) {
      using Put = FieldStore<decltype(field), Extra>;
      if constexpr (std::remove_cvref_t<decltype(field)>::per_membrane) {
        std::remove_reference_t<decltype(column)> wide(rows_ * membranes * Put::width, absent<typename Put::Type>());
        for (std::size_t row = 0; row < rows_; ++row)
          std::copy_n(&column[row * most_ * Put::width], most_ * Put::width, &wide[row * membranes * Put::width]);
        column = std::move(wide);
      }
    });
    most_ = membranes;
  }

  const Table& table_;
  std::array<bool, std::tuple_size_v<Table>> wanted_{};
  ColumnsOf<Table, Extra> columns_;
  std::size_t rows_ = 0, most_ = 0;
};

/// Columns of servo-step snapshots.
class SnapshotColumns : public TickColumns<decltype(tick_table)> {
 public:
  explicit SnapshotColumns(std::initializer_list<std::string_view> only = {}) : TickColumns(tick_table, only) {}
};

}  // namespace punctura::bindings
