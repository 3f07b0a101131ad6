// The whole tick, gate and limits included, goes on from a state that was kept to the same bits.
#include <doctest/doctest.h>

#include <cmath>
#include <cstring>
#include <vector>

#include "../support/paper_scene.hpp"
#include "../support/random_motion.hpp"
#include "punctura/scene/build.hpp"
#include "punctura/state/archive.hpp"

using namespace punctura;
using namespace punctura::test;

namespace {

DeviceSample sample_at(std::uint64_t k, Noise& noise) {
  DeviceSample sample{};
  sample.healthy = true;
  sample.sequence = k;
  sample.time = static_cast<double>(k) / 1600;
  sample.position = {1e-5 * noise.normal(), 2e-3 - 6e-3 * std::sin(0.002 * static_cast<double>(k)), 0};
  sample.axis = {0, -1, 0};
  sample.motor_temperature = 0.5;
  return sample;
}

/// Bit for bit, but for what the step does not compute.
bool same_tick(const Snapshot& a, const Snapshot& b) {
  return a.tick == b.tick && a.state == b.state && a.fault == b.fault && a.commands == b.commands &&
         a.limit == b.limit && std::memcmp(&a.limits, &b.limits, sizeof a.limits) == 0 &&
         std::memcmp(a.force.data(), b.force.data(), sizeof a.force) == 0 &&
         std::memcmp(a.model_force.data(), b.model_force.data(), sizeof a.model_force) == 0 &&
         std::memcmp(&a.ceiling, &b.ceiling, sizeof a.ceiling) == 0;
}

}  // namespace

TEST_CASE("a servo step that was kept goes on to the same bits in another one: armed, faded, limited and faulted") {
  Scene softer = paper_scene();
  softer.membranes[0].membrane.friction = 0.1;
  const ForceLimits tight{0.4, 0.2};
  int active = 0, limited = 0, faulted = 0;
  for (const std::uint64_t kept_at : {0u, 1u, 400u, 1000u, 2000u, 2101u, 3500u}) {
    auto step = build(paper_scene(), {}, tight);
    Noise noise(3);
    std::vector<std::byte> state;
    std::vector<Snapshot> rest;
    for (std::uint64_t k = 0; k < 4000; ++k) {
      if (k == 10) step.arm();
      if (k == 2000) {  // fades
        auto next = build(softer, {}, tight);
        next.resume(step);
        step = std::move(next);
      }
      if (k == kept_at) state = save_state(step);
      DeviceSample sample = sample_at(k, noise);
      if (k == 3400) sample.position[1] = 5;  // a jump: the fault stays
      const Snapshot& made = step.step(sample);
      if (k >= kept_at) rest.push_back(made);
      active += made.state == ServoState::active;
      limited += made.limit != Limit::none;
      faulted += made.fault != Fault::none;
    }
    auto again = build(kept_at < 2000 ? paper_scene() : softer, {}, tight);
    REQUIRE(load_state(again, state));
    Noise same(3);
    for (std::uint64_t k = 0; k < 4000; ++k) {
      const DeviceSample given = sample_at(k, same);
      if (k < kept_at) continue;
      if (k == 10) again.arm();
      if (k == 2000 && kept_at < 2000) {
        auto next = build(softer, {}, tight);
        next.resume(again);
        again = std::move(next);
      }
      DeviceSample sample = given;
      if (k == 3400) sample.position[1] = 5;
      CAPTURE(kept_at);
      CAPTURE(k);
      REQUIRE(same_tick(again.step(sample), rest[k - kept_at]));
    }
  }
  CHECK(active > 1000);
  CHECK(limited > 1000);
  CHECK(faulted > 1000);
}

TEST_CASE("the state of a servo step is refused by one with other limits, another gate or another period") {
  auto step = build(paper_scene());
  const auto state = save_state(step);
  auto same = build(paper_scene());
  auto weaker = build(paper_scene(), {}, {1.0});
  auto buttoned = build(paper_scene(), {.dead_man = 1});
  Scene slow = paper_scene();
  slow.servo.rate = 1000;
  auto slower = build(slow);
  CHECK(load_state(same, state));
  CHECK_FALSE(load_state(weaker, state));
  CHECK_FALSE(load_state(buttoned, state));
  CHECK_FALSE(load_state(slower, state));
}
