// Converts snapshots to columns, by the table of tick fields.
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <memory>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

#include "bindings.hpp"
#include "punctura/lab/plant/experiment.hpp"

namespace punctura::bindings {

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

/// Whether a field is one of this record.
template <typename Record, typename Field>
inline constexpr bool is_of = std::is_same_v<typename std::remove_cvref_t<Field>::Record, Record>;
template <typename Field>
struct FieldStore : Stored<typename std::remove_cvref_t<Field>::Value> {
  using Value = typename std::remove_cvref_t<Field>::Value;
};

/// One std::vector for each field of a table.
template <typename... Fields>
std::tuple<std::vector<typename FieldStore<Fields>::Type>...> columns_of_table(const std::tuple<Fields...>&);
template <typename Table>
using ColumnsOf = decltype(columns_of_table(std::declval<Table>()));

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

/// Collects snapshots without the GIL, then returns a punctura.Ticks with one row per snapshot. Compiled once, in
/// tick_table.cpp, because the loops over the fields take a compiler seconds.
class TickColumns {
 public:
  /// only: names of the fields to keep; empty for all. with_extra: also what only an experiment knows.
  explicit TickColumns(const std::vector<std::string_view>& only = {}, bool with_extra = false);
  ~TickColumns();
  /// Throws MemoryError that names the number of rows.
  void reserve(std::size_t rows, std::size_t membranes = 0);
  void add(const Snapshot& record, const ExperimentExtra& extra = {});
  /// components: of a vector, 3, or 1 on a line. single: one membrane; the arrays have no axis for membranes.
  TicksObject to_ticks(std::size_t components = 3, bool single = false);

 private:
  struct Columns;
  std::unique_ptr<Columns> columns_;
};

}  // namespace punctura::bindings
