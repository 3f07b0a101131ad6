#include "punctura_runtime/batch/fleet_block.hpp"

#include <algorithm>

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

}  // namespace punctura::batch
