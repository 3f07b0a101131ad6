// The steps of single lanes. Compiled without special instructions, as they may run on every processor.
#include "punctura_runtime/batch/line_block.hpp"

#include <bit>

namespace punctura::batch {

void load_pieces(LineBlock& block, std::size_t start, unsigned lanes, const double* q) noexcept {
  for (; lanes != 0; lanes &= lanes - 1) {
    const auto i = static_cast<std::size_t>(std::countr_zero(lanes));
    const BandTable& table = block.table[start + i];
    table.load(table.pieces, block, start + i, q[i]);
  }
}

void exact_forces(const LineBlock& block, std::size_t start, unsigned lanes, const double* q_prev, const double* f_star,
                  double* force) noexcept {
  for (; lanes != 0; lanes &= lanes - 1) {
    const auto i = static_cast<std::size_t>(std::countr_zero(lanes));
    const BandTable& table = block.table[start + i];
    force[i] = table.exact_force(table.pieces, q_prev[i], f_star[i], block.g.of[start + i]);
  }
}

}  // namespace punctura::batch
