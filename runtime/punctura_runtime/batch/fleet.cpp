#include "punctura_runtime/batch/fleet.hpp"

#include "punctura_runtime/batch/blocks.hpp"

namespace punctura::batch {

Fleet::Fleet(const FleetSetup& setup, std::size_t threads) : setup_(setup), threads_(usable_threads(threads)) {
  if (!setup_.code) setup_.code = line_codes().front();
  width_ = FleetBlock::width(*setup_.code);
}

void Fleet::place(std::size_t i, const Scene& scene, const Vector3d& start, std::uint64_t seed) {
  if (i == blocks_.size() * width_) blocks_.push_back(std::make_unique<FleetBlock>(setup_));
  blocks_[i / width_]->place(i % width_, scene, start, seed);
  size_ = std::max(size_, i + 1);
}

void Fleet::begin() {
  for (const auto& block : blocks_) block->begin();
}

void Fleet::step(const double* speed, std::size_t ticks) {
  Work work;
  for_each_block(blocks_.size(), threads_, work, [&](std::size_t i) { blocks_[i]->step(speed + i * width_, ticks); },
                 {});
}

TrialRecord Fleet::record(std::size_t i, std::size_t ticks) const {
  return blocks_[i / width_]->record(i % width_, ticks);
}

bool Fleet::in_lanes(std::size_t i) const noexcept { return blocks_[i / width_]->in_lanes(i % width_); }

}  // namespace punctura::batch
