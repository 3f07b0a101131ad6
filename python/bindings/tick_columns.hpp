// Converts snapshots to columns, by the table of tick fields.
#pragma once

#include <initializer_list>
#include <memory>
#include <string_view>
#include <variant>

#include "bindings.hpp"
#include "punctura/lab/plant/experiment_table.hpp"

namespace punctura::bindings {

/// Collects snapshots without the GIL, then returns a punctura.Ticks with one row per snapshot. Compiled once, in
/// tick_columns.cpp, because the loops over the fields take a compiler seconds.
template <typename Table, typename Extra = std::monostate>
class TickColumns {
 public:
  /// only: names of the fields to keep; empty for all.
  explicit TickColumns(const Table& table, std::initializer_list<std::string_view> only = {});
  ~TickColumns();
  /// Throws MemoryError that names the number of rows.
  void reserve(std::size_t rows, std::size_t membranes = 0);
  void add(const Snapshot& record, const Extra& extra = {});
  /// components: of a vector, 3, or 1 on a line. single: one membrane; the arrays have no axis for membranes.
  nb::object to_ticks(std::size_t components = 3, bool single = false);

 private:
  struct Columns;
  std::unique_ptr<Columns> columns_;
};
extern template class TickColumns<std::remove_const_t<decltype(tick_table)>>;
extern template class TickColumns<std::remove_const_t<decltype(experiment_table)>, ExperimentExtra>;

/// Columns of servo-step snapshots.
struct SnapshotColumns : TickColumns<std::remove_const_t<decltype(tick_table)>> {
  explicit SnapshotColumns(std::initializer_list<std::string_view> only = {}) : TickColumns(tick_table, only) {}
};
/// Columns of snapshots with what only an experiment knows.
struct ExperimentColumns : TickColumns<std::remove_const_t<decltype(experiment_table)>, ExperimentExtra> {
  ExperimentColumns() : TickColumns(experiment_table) {}
};

}  // namespace punctura::bindings
