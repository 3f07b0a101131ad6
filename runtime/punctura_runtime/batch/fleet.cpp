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

const TrialHistory& Fleet::history(std::size_t i) const noexcept { return blocks_[i / width_]->history(i % width_); }

void Fleet::restore(const std::vector<TrialHistory>& trials) {
  blocks_.clear();
  size_ = 0;
  std::size_t last = 0, begin = 0;
  for (const TrialHistory& trial : trials) last = std::max(last, trial.ticks);
  // All trials end in the tick `last`. Before its start a trial makes ticks that nobody sees.
  struct Place {
    std::size_t start, move, until;  ///< ticks; the present move and its end
  };
  std::vector<Place> places;
  for (const TrialHistory& trial : trials) {
    places.push_back({last - trial.ticks, 0, last - trial.ticks});
    if (trial.ticks > 0) begin = std::max(begin, last - trial.ticks + trial.begun);
  }
  std::vector<double> speed(trials.size());
  for (std::size_t tick = 0; tick <= last;) {
    std::size_t until = tick < begin ? begin : last;
    for (std::size_t i = 0; i < trials.size(); ++i) {
      const TrialHistory& trial = trials[i];
      Place& at = places[i];
      if (tick == at.start || tick == 0) place(i, trial.scene, trial.start, trial.seed);
      if (tick == at.until && at.move < trial.moves.size()) {
        speed[i] = trial.moves[at.move].speed;
        at.until += trial.moves[at.move++].ticks;
      }
      if (at.until > tick) until = std::min(until, at.until);
    }
    if (tick == begin) this->begin();
    if (tick == last) return;
    step(speed.data(), until - tick);
    tick = until;
  }
}

bool Fleet::in_lanes(std::size_t i) const noexcept { return blocks_[i / width_]->in_lanes(i % width_); }

}  // namespace punctura::batch
