#include "punctura_runtime/batch/fleet.hpp"

#include "punctura_runtime/batch/blocks.hpp"

namespace punctura::batch {

Fleet::Fleet(const FleetSetup& setup, std::size_t threads) : setup_(setup), threads_(usable_threads(threads)) {
  if (!setup_.code) setup_.code = line_codes().front();
}

void Fleet::place(std::size_t i, const Scene& scene, const Vector3d& start, std::uint64_t seed) {
  const std::size_t width = FleetBlock::width(*setup_.code);
  if (i == blocks_.size() * width) blocks_.push_back(std::make_unique<FleetBlock>(setup_));
  blocks_[i / width]->place(i % width, scene, start, seed);
  size_ = std::max(size_, i + 1);
}

void Fleet::begin() {
  for (const auto& block : blocks_) block->begin();
}

void Fleet::step(const double* speed, std::size_t ticks) {
  Work work;
  const std::size_t width = FleetBlock::width(*setup_.code);
  for_each_block(blocks_.size(), threads_, work, [&](std::size_t i) { blocks_[i]->step(speed + i * width, ticks); },
                 {});
}

TrialRecord Fleet::record(std::size_t i, std::size_t ticks) const {
  const std::size_t width = FleetBlock::width(*setup_.code);
  return blocks_[i / width]->record(i % width, ticks);
}

bool Fleet::in_lanes(std::size_t i) const noexcept {
  const std::size_t width = FleetBlock::width(*setup_.code);
  return blocks_[i / width]->in_lanes(i % width);
}

}  // namespace punctura::batch
