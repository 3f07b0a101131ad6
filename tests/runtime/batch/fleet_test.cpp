// A fleet in lanes: each trial has the bits of the same trial computed alone.
#include "punctura_runtime/batch/fleet.hpp"

#include <doctest/doctest.h>

#include <bit>
#include <cmath>
#include <functional>

#include "core/support/cases.hpp"
#include "core/support/paper_scene.hpp"

using namespace punctura;

namespace {

constexpr std::size_t fleet_trials = 37;  // whole blocks and a part of one

/// The scene of a trial: two walls, of which the second remembers its hole in every third trial.
Scene fleet_scene(Solver solver, std::size_t i) {
  Scene scene = test::paper_scene(1e-3 * static_cast<double>(i % 4), solver);
  const double share = static_cast<double>(i % 7) / 7;
  scene.membranes[0].membrane.friction = 0.05 + 0.3 * share;
  scene.membranes.push_back({"second", test::paper_membrane(0.3e-3), {0, -3e-3, 0}, {0.1, -1, 0.2}});
  if (i % 3 == 1) scene.membranes[1].tissue.cutting = 0.5;
  if (i % 3 == 1) scene.membranes[1].tissue.set = 0.4;
  scene.coupling.stiffness = 300 + 200 * share;
  scene.servo.low_pass = i % 5 == 0 ? 0 : 300;
  return scene;
}

Vector3d fleet_start(std::size_t i) { return {0, 1e-3 + 1e-4 * static_cast<double>(i % 5), 0}; }

/// The hand's speed of trial i in a step, m/s: in, out and at rest.
double fleet_speed(std::size_t i, std::size_t step) {
  return 0.05 * std::sin(0.7 * static_cast<double>(step) + static_cast<double>(i));
}

bool same_record(const batch::TrialRecord& a, const batch::TrialRecord& b) {
  using R = batch::TrialRecord;
  const auto same = [](double x, double y) {
    return std::bit_cast<std::uint64_t>(x) == std::bit_cast<std::uint64_t>(y);
  };
  for (const auto member : {&R::force, &R::lowest_force, &R::highest_force, &R::travel, &R::speed})
    if (!same(a.*member, b.*member)) return false;
  for (const auto member : {&R::depth, &R::deepest}) {
    if ((a.*member).size() != (b.*member).size()) return false;
    for (std::size_t j = 0; j < (a.*member).size(); ++j)
      if (!same((a.*member)[j], (b.*member)[j])) return false;
  }
  return a.fault == b.fault;
}

struct SetOfFleets {
  SetOfFleets(const Hand& hand, const std::function<Scene(std::size_t)>& scene_of) : scene_of_(scene_of) {
    for (const batch::LineCode* code : batch::line_codes()) {
      fleets.push_back(std::make_unique<batch::Fleet>(batch::FleetSetup{{}, hand, axis, code}, fleets.size() + 1));
      for (std::size_t i = 0; i < fleet_trials; ++i) place(*fleets.back(), i, i);
    }
    for (std::size_t i = 0; i < fleet_trials; ++i)
      alone.emplace_back(scene_of(i), fleet_start(i), axis, DeviceDynamics{}, hand, i);
    hand_ = hand;
  }
  void place(batch::Fleet& fleet, std::size_t i, std::size_t like) {
    fleet.place(i, scene_of_(like), fleet_start(like), like);
  }
  void place_again(std::size_t i, std::size_t like) {
    for (const auto& fleet : fleets) place(*fleet, i, like);
    alone[i] = batch::FleetTrial(scene_of_(like), fleet_start(like), axis, DeviceDynamics{}, hand_, like);
  }
  /// One step of each trial, in each fleet in parts of another size. Returns how many records differ from those of the
  /// trials alone.
  std::size_t step(const std::function<double(std::size_t)>& speed_of, std::size_t ticks) {
    std::vector<double> speed;
    for (std::size_t i = 0; i < fleet_trials; ++i) speed.push_back(speed_of(i));
    for (std::size_t i = 0; i < fleet_trials; ++i) {
      alone[i].begin();
      alone[i].step(speed[i], ticks);
    }
    std::size_t differ = 0, part = ticks;
    for (const auto& fleet : fleets) {
      fleet->begin();
      for (std::size_t done = 0; done < ticks; done += part) fleet->step(speed.data(), std::min(part, ticks - done));
      part = part / 2 + 1;
      for (std::size_t i = 0; i < fleet_trials; ++i)
        differ += !same_record(fleet->record(i, ticks), alone[i].record(ticks));
    }
    return differ;
  }
  /// Whether each fleet with lanes has this number of trials in them, and one without lanes none.
  bool in_lanes(std::size_t expected) const {
    for (const auto& fleet : fleets) {
      std::size_t count = 0;
      for (std::size_t i = 0; i < fleet_trials; ++i) count += fleet->in_lanes(i);
      if (count != (fleet->code().fleet_of(Solver::exact) ? expected : 0)) return false;
    }
    return true;
  }

  static inline const Vector3d axis = Vector3d(0.05, -1, 0.02).stableNormalized();
  std::vector<std::unique_ptr<batch::Fleet>> fleets;  // one for each instruction set
  std::vector<batch::FleetTrial> alone;

 private:
  std::function<Scene(std::size_t)> scene_of_;
  Hand hand_{};
};

}  // namespace

TEST_CASE("trials of a fleet have the bits of trials alone, also if some start anew in between") {
  for (const Solver solver : {Solver::paper, Solver::exact}) {
    SetOfFleets all({}, [&](std::size_t i) { return fleet_scene(solver, i); });
    std::size_t pierced = 0;
    for (std::size_t step = 0; step < 24; ++step) {
      CAPTURE(step);
      CHECK(all.step([&](std::size_t i) { return fleet_speed(i, step / 6); }, 35) == 0);
      for (const auto& trial : all.alone) pierced += trial.record(35).deepest[0] > 3e-3;
      if (step % 5 == 4) {
        all.place_again(fleet_trials - 1, step);  // the lane that the empty lanes follow
        all.place_again(step, step + 3);
      }
    }
    CHECK(pierced > 50);
    CHECK(all.in_lanes(fleet_trials));
  }
}

TEST_CASE("a trial that faults leaves the lanes with its whole record, and comes back when it starts anew") {
  SetOfFleets all({}, [&](std::size_t i) { return fleet_scene(Solver::exact, i); });
  const auto slow = [](std::size_t i) { return fleet_speed(i, 0); };
  CHECK(all.step(slow, 35) == 0);
  const auto jump = [](std::size_t i) { return i == 5 || i == 33 ? 1e3 : fleet_speed(i, 1); };
  for (int k = 0; k < 3; ++k) CHECK(all.step(jump, 35) == 0);
  CHECK(all.alone[5].record(35).fault == Fault::position_jump);
  CHECK(all.in_lanes(fleet_trials - 2));
  CHECK(all.step(slow, 35) == 0);
  all.place_again(5, 6);
  CHECK(all.in_lanes(fleet_trials - 1));
  CHECK(all.step(slow, 35) == 0);
}

TEST_CASE("a fleet that makes the history of another one goes on with its bits, in lanes and alone") {
  SetOfFleets all({}, [&](std::size_t i) { return fleet_scene(Solver::exact, i); });
  const auto jump = [](std::size_t i) { return i == 5 ? 1e3 : fleet_speed(i, 0); };
  CHECK(all.step(jump, 35) == 0);
  for (const std::size_t i : {std::size_t{1}, std::size_t{30}, std::size_t{36}}) all.place_again(i, i + 2);
  CHECK(all.step([](std::size_t i) { return fleet_speed(i, 0); }, 35) == 0);
  all.place_again(7, 3);  // has made no tick
  for (auto& fleet : all.fleets) {
    std::vector<batch::TrialHistory> histories;
    for (std::size_t i = 0; i < fleet_trials; ++i) histories.push_back(fleet->history(i));
    auto copy = std::make_unique<batch::Fleet>(batch::FleetSetup{{}, {}, SetOfFleets::axis, &fleet->code()}, 2);
    all.place(*copy, 0, 9);  // restore() forgets it
    copy->restore(histories);
    REQUIRE(copy->size() == fleet_trials);
    for (std::size_t i = 0; i < fleet_trials; ++i) {
      CHECK(copy->in_lanes(i) == fleet->in_lanes(i));
      if (i != 7) CHECK(same_record(copy->record(i, 35), fleet->record(i, 35)));
    }
    fleet = std::move(copy);
  }
  for (std::size_t step = 0; step < 4; ++step)
    CHECK(all.step([&](std::size_t i) { return fleet_speed(i, step); }, 35) == 0);
}

TEST_CASE("scenes of another kind than the others in their vector are computed alone, with the same bits") {
  const auto ticks = static_cast<std::size_t>(test::at_most(70));
  const double far = 70.0 / static_cast<double>(ticks);  // the same way in a shorter step
  const auto scene_of = [](std::size_t i) {
    Scene scene = fleet_scene(i % 16 == 7 ? Solver::paper : Solver::exact, i);
    if (i % 16 == 3) scene.membranes.pop_back();
    if (i % 16 == 4) scene.servo.sub_steps = 3;
    if (i % 16 == 9) scene.servo.conditioning = Conditioning::line_fit;
    if (i % 16 == 10) scene.relaxation = {{100, 0.1}};
    if (i % 16 == 13) scene.direction = Direction::motion;
    return scene;
  };
  SetOfFleets all({}, scene_of);
  for (std::size_t step = 0; step < 12; ++step)
    CHECK(all.step([&](std::size_t i) { return far * fleet_speed(i, step / 6); }, ticks) == 0);
  all.place_again(3, 8);
  all.place_again(8, 4);
  all.place_again(34, 35);
  for (std::size_t step = 0; step < 6; ++step)
    CHECK(all.step([&](std::size_t i) { return far * fleet_speed(i, 0); }, ticks) == 0);
}

TEST_CASE("a fleet in lanes takes every kind of scene, and another kind from the second time on that all start anew") {
  const auto ticks = static_cast<std::size_t>(test::at_most(70));
  const double far = 70.0 / static_cast<double>(ticks);  // the same way in a shorter step
  for (const bool wide : {false, true}) {
    const auto scene_of = [&](std::size_t i) {
      Scene scene = fleet_scene(Solver::paper, i);
      if (wide != (i >= 100)) {
        scene.servo.sub_steps = 2;
        scene.servo.conditioning = Conditioning::line_fit;
        scene.direction = Direction::motion;
        scene.relaxation = {{100, 0.1}};
      }
      return scene;
    };
    SetOfFleets all({}, scene_of);
    for (std::size_t step = 0; step < 12; ++step)
      CHECK(all.step([&](std::size_t i) { return far * fleet_speed(i, step / 6); }, ticks) == 0);
    CHECK(all.in_lanes(fleet_trials));
    for (int again = 0; again < 2; ++again) {
      for (std::size_t i = 0; i < fleet_trials; ++i) all.place_again(i, 100 + i);
      for (std::size_t step = 0; step < 4; ++step)
        CHECK(all.step([&](std::size_t i) { return far * fleet_speed(i, 0); }, ticks) == 0);
    }
    CHECK(all.in_lanes(fleet_trials));
  }
}
