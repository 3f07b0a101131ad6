// Converts snapshots to columns, by the table of tick fields.
#pragma once

#include <memory>
#include <string_view>
#include <vector>

#include "bindings.hpp"
#include "punctura/lab/plant/experiment_table.hpp"

namespace punctura::bindings {

/// Collects snapshots without the GIL, then returns a punctura.Ticks with one row per snapshot. Compiled once, in
/// tick_columns.cpp, because the loops over the fields take a compiler seconds.
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
