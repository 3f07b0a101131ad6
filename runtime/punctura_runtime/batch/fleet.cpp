#include "punctura_runtime/batch/fleet.hpp"

#include <algorithm>

#include "punctura_runtime/batch/blocks.hpp"

namespace punctura::batch {

FleetLanes::FleetLanes(std::size_t membranes) {
  record_.depth.resize(membranes);
  record_.deepest.resize(membranes);
}
FleetLanes::~FleetLanes() = default;

FleetBlock::FleetBlock(const FleetSetup& setup) : LaneTrials(true, width(*setup.code)), setup_(setup) {
  const Vector3d axis = setup.axis.stableNormalized();
  for (SceneBlock::Inputs& inputs : block_->inputs) {
    inputs.sample_axis = axis;
    inputs.axis = axis.stableNormalized();  // as the servo step does
  }
}

void FleetBlock::place(std::size_t i, const Scene& scene, const Vector3d& start, std::uint64_t seed) {
  const auto uses_lanes = [&](const Trial& trial) {
    return !trial.alone && static_cast<std::size_t>(&trial - trials_.data()) != i;
  };
  if (std::none_of(trials_.begin(), trials_.end(), uses_lanes)) {
    clear();
    state_.reset();
    for (Trial& trial : trials_) trial.lane = no_lane;
  }
  Trial made{{scene, start, seed}};
  made.lane = i < trials_.size() ? trials_[i].lane : no_lane;
  if (lanes_.empty()) {
    solver_ = scene.servo.solver;
    code_ = setup_.code->fleet_of(solver_);
  }
  const std::size_t lane = made.lane == no_lane ? lanes_.size() : made.lane;
  if (LaneTrial* own = code_ && scene.servo.solver == solver_ ? put(lane, scene, seed) : nullptr) {
    made.lane = lane;
    own->motion = Steered(start);
    put_hand(lane, setup_.plant, setup_.hand, start);
    if (!state_) state_ = code_(*block_);
    state_->restart(lane, end_of(lane));
  } else {
    made.alone = make(made.history);
  }
  if (i < trials_.size())
    trials_[i] = std::move(made);
  else
    trials_.push_back(std::move(made));
}

void FleetBlock::begin() {
  if (state_) state_->begin();
  for (Trial& trial : trials_) {
    trial.history.begin();
    if (trial.alone)
      trial.alone->begin();
    else
      trial.travel = state_->record().travel.of[trial.lane];
  }
}

void FleetBlock::step(const double* speed, std::size_t ticks) {
  bool some = false;
  for (std::size_t i = 0; i < trials_.size(); ++i) {
    Trial& trial = trials_[i];
    trial.history.step(speed[i], ticks);
    if (trial.alone) {
      trial.alone->step(speed[i], ticks);
      continue;
    }
    std::get<Steered>(lanes_[trial.lane].motion).steer(speed[i] * block_->inputs[0].sample_axis);
    some = true;
  }
  if (!some) return;
  std::uint64_t invalid = 0;
  for (std::size_t done = 0; done < ticks; done += scene_ticks) {
    const std::size_t now = std::min(scene_ticks, ticks - done);
    for (const Trial& trial : trials_)
      if (!trial.alone) fill(trial.lane, trial.history.ticks - ticks + done, now);
    state_->step(now);
    invalid |= state_->record().invalid;
  }
  for (Trial& trial : trials_)
    if (!trial.alone && (invalid >> trial.lane & 1u) != 0) trial.alone = make(trial.history);
}

std::unique_ptr<FleetTrial> FleetBlock::make(const TrialHistory& history) const {
  auto alone =
      std::make_unique<FleetTrial>(history.scene, history.start, setup_.axis, setup_.plant, setup_.hand, history.seed);
  std::size_t tick = 0;
  for (const TrialHistory::Move& move : history.moves) {
    if (tick == history.begun) alone->begin();
    alone->step(move.speed, move.ticks);
    tick += move.ticks;
  }
  return alone;
}

TrialRecord FleetBlock::record(std::size_t i, std::size_t ticks) const {
  const Trial& trial = trials_[i];
  if (trial.alone) return trial.alone->record(ticks);
  const FleetRecord& all = state_->record();
  const std::size_t lane = trial.lane;
  TrialRecord record{all.force.of[lane],
                     all.lowest_force.of[lane],
                     all.highest_force.of[lane],
                     all.travel.of[lane],
                     (all.travel.of[lane] - trial.travel) / (static_cast<double>(ticks) * lanes_[lane].period),
                     Fault::none,
                     {},
                     {}};
  for (const LaneNumbers& depth : all.depth) record.depth.push_back(depth.of[lane]);
  for (const LaneNumbers& deepest : all.deepest) record.deepest.push_back(deepest.of[lane]);
  return record;
}

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
