// A law given by a table: straight lines between knots.
#pragma once

#include <cmath>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "punctura/model/law.hpp"
#include "punctura/model/profile.hpp"

namespace punctura {

/// Adds every reason why depths (m) and edges (N) are no table.
inline void check_table(std::span<const double> depth, std::span<const double> lower, std::span<const double> upper,
                        std::vector<Problem>& problems) {
  const auto add = [&](const char* column, std::size_t i, double value, const char* reason) {
    problems.push_back({std::string(column) + "[" + std::to_string(i) + "]", value, reason});
  };
  const std::size_t n = depth.size();
  static_assert(max_knots == 32);
  if (n == 0 || n > max_knots) problems.push_back({"depth", static_cast<double>(n), "must have 1 to 32 knots"});
  if (lower.size() != n)
    problems.push_back({"lower", static_cast<double>(lower.size()), "must have one number a knot"});
  if (upper.size() != n)
    problems.push_back({"upper", static_cast<double>(upper.size()), "must have one number a knot"});
  if (lower.size() != n || upper.size() != n) return;
  for (std::size_t i = 0; i < n; ++i) {
    if (!(depth[i] >= 0 && depth[i] <= 1e6)) add("depth", i, depth[i], "must be a number from 0 to 1e6 m");
    if (i > 0 && !(depth[i] - depth[i - 1] >= 1e-9))
      add("depth", i, depth[i], "must be greater than the depth before it, by 1e-9 m or more");
    if (!(std::abs(lower[i]) <= 1e6)) add("lower", i, lower[i], "must be a number within 1e6 N");
    if (!(std::abs(upper[i]) <= 1e6)) add("upper", i, upper[i], "must be a number within 1e6 N");
    if (lower[i] > 0) add("lower", i, lower[i], "must be 0 N or less: the lower edge resists insertion");
    if (lower[i] > upper[i]) add("lower", i, lower[i], "must not be greater than upper at the same knot");
  }
}

/// A band whose edges are straight lines between knots. Before the first knot there is no friction; behind the last one
/// the edges are constant. The edges may jump at the first knot.
class TableLaw {
 public:
  using Scalar = double;
  using Pieces = PiecewiseBand<double, max_knots + 1>;

  /// depth: of the knots, m, ascending. lower, upper: Phi_I and Phi_O there, N. They must have passed check_table().
  TableLaw(std::span<const double> depth, std::span<const double> lower, std::span<const double> upper) noexcept {
    const std::size_t n = depth.size();
    pieces_.breaks.fill(no_bound);
    for (std::size_t i = 0; i < n; ++i) {
      pieces_.breaks[i] = depth[i];
      const double width = i + 1 < n ? depth[i + 1] - depth[i] : no_bound;
      const auto edge = [&](std::span<const double> at) {
        return Quadratic<double>{at[i], i + 1 < n ? (at[i + 1] - at[i]) / width : 0, 0};
      };
      pieces_.pieces[i + 1] = {depth[i], edge(lower), edge(upper)};
    }
    for (std::size_t i = n + 1; i <= max_knots; ++i) pieces_.pieces[i] = pieces_.pieces[n];
  }

  const Pieces& pieces() const noexcept { return pieces_; }
  Band<double> band(double q) const noexcept { return pieces_.band(q); }

 private:
  Pieces pieces_{};
};
static_assert(Law<TableLaw>);

}  // namespace punctura
