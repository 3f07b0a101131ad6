// Batches of proxies on a line: each trial has the bits of Proxy1d.
#include "punctura_runtime/batch/line_batch.hpp"

#include <doctest/doctest.h>

#include <bit>
#include <cstring>

#include "core/support/random_motion.hpp"
#include "punctura/model/profile_law.hpp"
#include "punctura/model/thin_law.hpp"
#include "punctura/proxy/proxy_1d.hpp"
#include "punctura_runtime/batch/blocks.hpp"

using namespace punctura;

namespace {

constexpr double line_batch_period = 1 / 1600.0;

/// Trials of three kinds of laws, with random parameters and motions, and the forces of Proxy1d.
struct LineBatchCase {
  std::size_t trials, ticks;
  std::vector<ThickLaw> thick;
  std::vector<ThinLaw> thin;
  std::vector<ProfileLaw> profiles;
  std::vector<Coupling> couplings;
  std::vector<double> depth, force;  ///< (ticks, trials)

  LineBatchCase(std::size_t n, std::size_t k, Solver solver, std::uint64_t seed)
      : trials(n), ticks(k), depth(n * k), force(n * k) {
    Noise noise(seed);
    for (std::size_t i = 0; i < n; ++i) {
      test::LawCase c = test::random_law(noise, 1e-6);  // thin walls: (29) has several solutions there
      if (noise.uniform() < 0.2) c.membrane.thickness = 0;
      thick.emplace_back(c.needle, c.membrane, c.obliquity);
      thin.emplace_back(c.needle, c.membrane);
      const Knot knots[] = {{1e-3 * noise.uniform(), -0.1, 0}, {2e-3, -1 - noise.uniform(), 0.3}, {3e-3, -0.5, 0.5}};
      profiles.emplace_back(Profile(knots), noise.uniform() < 0.5 ? 0 : 0.5e-3);
      couplings.push_back(test::random_coupling(noise));
      const auto motion =
          test::random_motion(noise, k, thick[i].constants().X + 2 * c.membrane.thickness + 2e-3, line_batch_period);
      for (std::size_t j = 0; j < k; ++j) depth[j * n + i] = motion[j];
      const auto alone = [&](const auto& law) {
        Proxy1d proxy(law, couplings[i], line_batch_period, solver);
        for (std::size_t j = 0; j < k; ++j) force[j * n + i] = proxy.step(motion[j]);
      };
      with_law(i, alone);
    }
  }

  void with_law(std::size_t i, auto&& function) const {
    if (i % 4 == 2)
      function(thin[i]);
    else if (i % 4 == 3)
      function(profiles[i]);
    else
      function(thick[i]);
  }

  batch::LineBatch made(Solver solver) const {
    batch::LineBatch all(line_batch_period, solver);
    for (std::size_t i = 0; i < trials; ++i) with_law(i, [&](const auto& law) { all.add(law.pieces(), couplings[i]); });
    return all;
  }
};

bool same_bits_all(const std::vector<double>& a, const std::vector<double>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0;
}

}  // namespace

TEST_CASE("a batch has the bits of Proxy1d with each instruction set, block, number of threads and layout") {
  for (const Solver solver : {Solver::paper, Solver::exact}) {
    const LineBatchCase c(75, 700, solver, 11);
    for (const batch::LineCode* code : batch::line_codes()) {
      CAPTURE(code->name);
      batch::LineBatch all = c.made(solver);
      std::vector<double> force(c.force.size());
      const auto n = static_cast<std::ptrdiff_t>(c.trials), ticks = static_cast<std::ptrdiff_t>(c.ticks);
      for (const std::size_t threads : {1u, 2u, 7u})
        for (const std::size_t block : {1u, 32u, 100u, 4096u}) {
          all.reset();
          batch::RunOptions options;
          options.threads = threads;
          options.block = block;
          options.code = code;
          CHECK(all.run(c.ticks, {c.depth.data(), n, 1}, {force.data(), n, 1}, options).finished());
          CHECK(same_bits_all(force, c.force));
        }
      // In several runs, with the layout in which the numbers of a trial follow each other.
      std::vector<double> depth(c.depth.size()), rows(c.depth.size());
      for (std::size_t k = 0; k < c.ticks; ++k)
        for (std::size_t i = 0; i < c.trials; ++i) depth[i * c.ticks + k] = c.depth[k * c.trials + i];
      all.reset();
      batch::RunOptions options;
      options.code = code;
      for (std::ptrdiff_t from = 0, part = 1; from < ticks; from += part, part = 3 * part + 1)
        all.run(static_cast<std::size_t>(std::min(part, ticks - from)), {depth.data() + from, 1, ticks},
                {rows.data() + from, 1, ticks}, options);
      for (std::size_t k = 0; k < c.ticks; ++k)
        for (std::size_t i = 0; i < c.trials; ++i) force[k * c.trials + i] = rows[i * c.ticks + k];
      CHECK(same_bits_all(force, c.force));
    }
  }
}

TEST_CASE("a batch with one motion for all trials") {
  const LineBatchCase c(40, 300, Solver::exact, 12);
  batch::LineBatch all = c.made(Solver::exact);
  std::vector<double> force(c.force.size());
  all.run(c.ticks, {c.depth.data(), 40, 0}, {force.data(), 40, 1}, {});
  for (std::size_t i = 0; i < c.trials; ++i)
    c.with_law(i, [&](const auto& law) {
      Proxy1d proxy(law, c.couplings[i], line_batch_period);
      for (std::size_t k = 0; k < c.ticks; ++k) REQUIRE(proxy.step(c.depth[k * 40]) == force[k * 40 + i]);
    });
}

TEST_CASE("a run of a batch that cannot finish changes no state") {
  LineBatchCase c(40, 600, Solver::exact, 13);
  batch::LineBatch all = c.made(Solver::exact);
  std::vector<double> force(c.force.size());
  c.depth[500 * 40 + 33] = std::nan("");
  c.depth[300 * 40 + 35] = 2e6;
  const auto outcome = all.run(c.ticks, {c.depth.data(), 40, 1}, {force.data(), 40, 1}, {});
  REQUIRE(outcome.bad);
  CHECK(outcome.bad->tick < 600);
  CHECK((outcome.bad->trial == 33 || outcome.bad->trial == 35));
  CHECK(all.run(200, {c.depth.data(), 40, 1}, {force.data(), 40, 1}, {}).finished());
  CHECK(std::memcmp(force.data(), c.force.data(), 200 * 40 * sizeof(double)) == 0);

  batch::RunOptions options;
  options.watch = [](std::size_t, std::size_t) { return false; };
  const std::vector<double> rest(40, -1e-3);  // so long that watch() is called
  const auto stopped = all.run(20'000'000, {rest.data(), 0, 1}, {force.data(), 0, 1}, options);
  CHECK(stopped.stopped);
  all.run(100, {c.depth.data() + 200 * 40, 40, 1}, {force.data() + 200 * 40, 40, 1}, {});
  CHECK(std::memcmp(force.data(), c.force.data(), 300 * 40 * sizeof(double)) == 0);
}

TEST_CASE("an exception in a block or in watch() ends all threads and reaches the caller") {
  batch::Work work;
  const auto good = [] { return true; };
  CHECK_THROWS_WITH(batch::for_each_block(
                        50, 3, work,
                        [](std::size_t i) {
                          if (i == 7) throw std::runtime_error("seven");
                        },
                        good),
                    "seven");
  std::atomic<int> blocks{0};
  batch::Work other;
  batch::for_each_block(50, 3, other, [&](std::size_t) { ++blocks; }, good);
  CHECK(blocks == 50);
}

TEST_CASE("every build for 64-bit x86 has SSE2, every one for 64-bit ARM has NEON, and the plain code comes last") {
#if defined(__x86_64__)
  CHECK(batch::line_code("sse2") != nullptr);
#elif defined(__aarch64__)
  CHECK(batch::line_code("neon") == batch::line_codes().front());
#endif
  CHECK(batch::line_codes().back() == batch::line_code("portable"));
}
