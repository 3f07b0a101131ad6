// How the field of a tick is stored in an array.
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <string>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

#include "punctura/lab/plant/experiment_table.hpp"

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

/// Whether a field is one of this record.
template <typename Record, typename Field>
inline constexpr bool is_of = std::is_same_v<typename std::remove_cvref_t<Field>::Record, Record>;
/// The stored type of a field.
template <typename Field>
struct FieldStore : Stored<typename std::remove_cvref_t<Field>::Value> {
  using Value = typename std::remove_cvref_t<Field>::Value;
};

/// One std::vector for each field of a table.
template <typename... Fields>
std::tuple<std::vector<typename FieldStore<Fields>::Type>...> columns_of_table(const std::tuple<Fields...>&);
template <typename Table>
using ColumnsOf = decltype(columns_of_table(std::declval<Table>()));

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

}  // namespace punctura::bindings
