// The C ABI gives the forces of the core, bit for bit, and its ticks allocate no memory.
#include <bit>
#include <cmath>

#include "c99.h"
#include "golden/golden_scenes.hpp"
#include "handles.hpp"
#include "punctura/proxy/proxy_1d.hpp"
#include "punctura/scene/build.hpp"
#include "support/allocations.hpp"

namespace {
using namespace capi_test;
using punctura::Vector3d;

bool same_bits(const double* a, const Vector3d& b) {
  for (std::size_t i = 0; i < 3; ++i)
    if (std::bit_cast<std::uint64_t>(a[i]) != std::bit_cast<std::uint64_t>(b[i])) return false;
  return true;
}

punctura::test::GoldenCase capi_case(std::size_t k) {
  auto c = punctura::test::golden_case(k);
  c.scene.servo.solver = k % 2 == 0 ? punctura::Solver::exact : punctura::Solver::paper;
  if (k % 3 == 2) c.scene.servo.conditioning = punctura::Conditioning::line_fit;
  return c;
}
}  // namespace

TEST_CASE("C ABI: an insertion gives the forces of the core, bit for bit, by step, by run, and by peek and commit") {
  for (std::size_t k = 0; k < 12; ++k) {
    INFO("scene " << k);
    const auto c = capi_case(k);
    const auto scene = through_c(c.scene);
    auto core = punctura::build_insertion(c.scene);
    const auto make = [&](auto** to) { return punctura_insertion_new(scene.get(), to); };
    const auto stepped = made<InsertionHandle>(make), peeked = made<InsertionHandle>(make),
               run = made<InsertionHandle>(make);
    std::vector<double> forces(3 * c.positions.size());
    CHECK(punctura_insertion_run(run.get(), c.positions.size(), c.positions[0].data(), c.axis.data(), 0,
                                 forces.data()) == PUNCTURA_OK);
    bool same = true;
    const std::size_t before = punctura::test::allocations();
    for (std::size_t i = 0; i < c.positions.size(); ++i) {
      const Vector3d expected = core.step(c.positions[i], c.axis.stableNormalized());
      double force[3], other[3];
      same &= punctura_insertion_step(stepped.get(), c.positions[i].data(), c.axis.data(), force) == PUNCTURA_OK &&
              same_bits(force, expected) && same_bits(forces.data() + 3 * i, expected);
      const Vector3d wrong = c.positions[i] + Vector3d(1e-3, 0, 0);
      same &= punctura_insertion_peek(peeked.get(), wrong.data(), c.axis.data(), other) == PUNCTURA_OK &&
              punctura_insertion_peek(peeked.get(), c.positions[i].data(), c.axis.data(), other) == PUNCTURA_OK &&
              same_bits(other, expected) && punctura_insertion_commit(peeked.get()) == PUNCTURA_OK;
    }
    CHECK(same);
    CHECK(punctura::test::allocations() == before);
    punctura_membrane_tick tick;
    tick.struct_size = sizeof tick;
    REQUIRE(punctura_insertion_membrane(peeked.get(), 0, &tick) == PUNCTURA_OK);
    CHECK(tick.axial_force == core.tick(0).axial_force);
    CHECK(tick.phase == static_cast<int>(core.tick(0).phase));
  }
}

TEST_CASE("C ABI: proxies on a line and in space give the forces of the core, bit for bit") {
  for (std::size_t k = 0; k < 6; ++k) {
    INFO("scene " << k);
    const auto c = capi_case(k);
    const auto scene = through_c(c.scene);
    const auto line = made<Proxy1dHandle>([&](auto** to) { return punctura_proxy1d_new(scene.get(), 0, to); });
    const auto space = made<Proxy3dHandle>([&](auto** to) { return punctura_proxy3d_new(scene.get(), 0, to); });
    const auto insertion = punctura::build_insertion(c.scene);
    auto in_space = (*insertion.k06())[0];
    punctura::Proxy1d on_a_line(in_space.law(), in_space.params().coupling, in_space.solver());
    bool same = true;
    for (const Vector3d& p : c.positions) {
      const double depth = -p.y();
      const Vector3d expected = in_space.step(p, c.axis.stableNormalized());
      double force[3];
      same &= std::bit_cast<std::uint64_t>(punctura_proxy1d_peek(line.get(), depth)) ==
                  std::bit_cast<std::uint64_t>(on_a_line.step(depth)) &&
              punctura_proxy1d_commit(line.get()) == PUNCTURA_OK;
      same &= punctura_proxy3d_step(space.get(), p.data(), c.axis.data(), force) == PUNCTURA_OK &&
              same_bits(force, expected);
    }
    CHECK(same);
  }
}

TEST_CASE("C ABI: a servo gives the record of the core's step; a program in C99 uses it") {
  double largest = 0;
  SceneHandle from_c(c99_scene());
  INFO(punctura_last_error());
  REQUIRE(from_c);
  CHECK(c99_push(from_c.get(), &largest) > 1000);
  CHECK(largest == doctest::Approx(0.2 * 2 * (570 * 1.08e-3 + 0.41)).epsilon(0.2));

  const auto c = capi_case(0);
  const auto scene = through_c(c.scene);
  auto core = punctura::build(c.scene);
  const auto servo = made<ServoHandle>([&](auto** to) { return punctura_servo_new(scene.get(), nullptr, to); });
  punctura_sample sample;
  REQUIRE(punctura_sample_init(&sample, sizeof sample) == PUNCTURA_OK);
  punctura_record record;
  record.struct_size = sizeof record;
  core.arm();
  punctura_servo_arm(servo.get());
  const std::size_t before = punctura::test::allocations();
  bool same = true;
  for (std::size_t i = 0; i < c.positions.size(); ++i) {
    sample.sequence = i;
    sample.time = static_cast<double>(i) / c.scene.servo.rate;
    for (std::size_t j = 0; j < 3; ++j) {
      sample.position[j] = c.positions[i][j];
      sample.axis[j] = c.axis[j];
    }
    const auto& expected = core.step({i, sample.time, to_array(c.positions[i]), to_array(c.axis), 0, true});
    same &= punctura_servo_step(servo.get(), &sample, &record) == PUNCTURA_OK &&
            same_bits(record.force, Vector3d(expected.force)) &&
            same_bits(record.model_force, Vector3d(expected.model_force)) &&
            record.fault == static_cast<int>(expected.fault) && record.state == static_cast<int>(expected.state) &&
            record.ceiling == expected.ceiling && record.tick == expected.tick;
  }
  CHECK(same);
  CHECK(punctura::test::allocations() == before);
  sample.position[0] = std::nan("");
  CHECK(punctura_servo_step(servo.get(), &sample, &record) == PUNCTURA_OK);
  CHECK(record.state == PUNCTURA_FAULTED);
  CHECK(record.force[1] == 0);
  CHECK(std::string(punctura_fault_text(record.fault)).find("a number that is not finite") != std::string::npos);

  // A call that makes no tick leaves no force of an earlier tick in the record.
  const auto refused = [&](punctura_servo* to, std::size_t sample_size, std::size_t record_size) {
    for (const auto call : {punctura_servo_step, punctura_servo_peek}) {
      INFO("sample.struct_size " << sample_size << ", record.struct_size " << record_size);
      sample.struct_size = sample_size;
      record.struct_size = record_size;
      record.force[1] = record.model_force[1] = record.thumb_force = 3;
      CHECK(call(to, sample_size == 0 ? nullptr : &sample, &record) == PUNCTURA_BAD_ARGUMENT);
      CHECK(record.force[1] == 0);
      CHECK(record.model_force[1] == 0);
      CHECK(record.thumb_force == 0);
    }
  };
  const std::size_t right = sizeof sample, whole = sizeof record;
  for (const std::size_t wrong : {std::size_t{0}, std::size_t{8}, whole / 2, whole - 1})
    refused(servo.get(), right, wrong);
  for (const std::size_t wrong : {std::size_t{0}, std::size_t{8}, right - 1}) refused(servo.get(), wrong, whole);
  refused(nullptr, right, whole);
}
