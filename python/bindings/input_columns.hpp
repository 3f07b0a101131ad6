// The inputs of recorded ticks, read by the table of tick fields.
#pragma once

#include <stdexcept>
#include <string>

#include "tick_store.hpp"

namespace punctura::bindings {

class InputColumns {
 public:
  /// columns: punctura.Ticks, or any mapping. Throws KeyError for a missing field, ValueError for a wrong shape.
  explicit InputColumns(const nb::object& columns) {
    const nb::object as_array = nb::module_::import_("numpy").attr("ascontiguousarray");
    rows_ = nb::len(nb::object(columns["tick"]));
    each(*this, [&](const auto& field, auto& values) {
      using T = typename std::remove_reference_t<decltype(values)>::value_type;
      const nb::object given = columns[field.name];
      const auto array = nb::cast<nb::ndarray<nb::numpy, const T, nb::c_contig, nb::device::cpu>>(
          as_array(real_numbers(given, field.name, dtype_name<T>().c_str())));
      if (array.ndim() == 0 || array.shape(0) != rows_ || array.size() != rows_ * width<decltype(field)>)
        throw std::invalid_argument(std::string(field.name) + " must have one row for each tick");
      values.assign(array.data(), array.data() + array.size());
    });
  }
  std::size_t rows() const noexcept { return rows_; }

  /// Copies the sample and the commands of a row into a snapshot.
  void read(std::size_t row, Snapshot& into) const {
    each(*this, [&](const auto& field, const auto& values) {
      auto& value = field.get(into);
      if constexpr (width<decltype(field)> == 3)
        std::copy_n(&values[3 * row], 3, value.begin());
      else
        value = static_cast<std::remove_reference_t<decltype(value)>>(values[row]);
    });
  }

 private:
  template <typename Field>
  static constexpr std::size_t width = FieldStore<Field>::width;

  template <typename Self, typename Do>
  static void each(Self& self, Do&& act) {
    for_each_field(tick_table, [&](const auto& field, auto i) {
      using F = std::remove_cvref_t<decltype(field)>;
      if constexpr (F::part == TickPart::snapshot) {
        if constexpr (F::template stored<Snapshot>)
          if (field.use & use_input) act(field, std::get<i>(self.columns_));
      }
    });
  }

  ColumnsOf<decltype(tick_table)> columns_;
  std::size_t rows_ = 0;
};

}  // namespace punctura::bindings
