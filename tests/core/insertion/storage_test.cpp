// FixedStorage: an insertion without a heap has the same bits, and the program aborts if the bounds are exceeded.
#include <doctest/doctest.h>

#ifndef _WIN32
#include <sys/wait.h>
#include <unistd.h>
#include <csignal>
#endif

#include "../support/allocations.hpp"
#include "../support/paper_scene.hpp"
#include "../support/random_motion.hpp"
#include "../support/tick.hpp"
#include "punctura/insertion/insertion.hpp"
#include "punctura/state/archive.hpp"

using namespace punctura;
using namespace punctura::test;

namespace {

using Site = SiteOf<ThickLaw>;
using Fixed = InsertionOf<ThickLaw, SampledCoupling<double>, FixedStorage<3>>;
static_assert(std::is_trivially_copyable_v<FixedVector<Proxy3d<ThickLaw>, 3>>);

const SampledCoupling<double> sampled({400, 1}, T);

std::vector<Site> walls(std::size_t n) {
  std::vector<Site> sites;
  for (std::size_t i = 0; i < n; ++i)
    sites.push_back({{paper_needle, paper_membrane(1e-3)}, {0, -3e-3 * static_cast<double>(i), 0}, {0, -1, 0}});
  return sites;
}

template <typename Run>
bool aborts([[maybe_unused]] Run run) {
#ifdef _WIN32
  return true;
#else
  const pid_t child = fork();
  if (child == 0) {
    std::signal(SIGABRT, SIG_DFL);
    run();
    _exit(0);
  }
  int status = 0;
  waitpid(child, &status, 0);
  return WIFSIGNALED(status) && WTERMSIG(status) == SIGABRT;
#endif
}

}  // namespace

TEST_CASE("with FixedStorage, forces and states have the same bits as with HeapStorage") {
  for (Direction direction : {Direction::stylus, Direction::motion})
    for (Conditioning conditioning : {Conditioning::low_pass, Conditioning::line_fit}) {
      const auto sites = walls(3);
      const auto before = allocations();
      Fixed fixed(sites, sampled, T, Solver::exact, 300, direction, conditioning, 0.055e-3);
      Fixed again(sites, sampled, T, Solver::exact, 300, direction, conditioning, 0.055e-3);
      CHECK(allocations() == before);
      InsertionOf<ThickLaw> heap(sites, sampled, T, Solver::exact, 300, direction, conditioning, 0.055e-3);
      Noise noise(140);
      for (double depth : random_motion(noise, 4000, 10e-3, T)) {
        const Vector3d p{0, -depth, 1e-3 * depth};
        REQUIRE(fixed.step(p, {0, -1, 0}) == heap.step(p, {0, -1, 0}));
      }
      CHECK(heap.force().norm() > 0);
      CHECK(save_state(fixed) == save_state(heap));
      again.resume(fixed);
      CHECK(again.proxies()[2].position() == heap.proxies()[2].position());
    }
}

TEST_CASE("too many sites or a too high rate abort the program") {
  const auto four = walls(4);
  const auto one = walls(1);
  CHECK(aborts([&] { Fixed insertion(four, sampled, T); }));
  CHECK(aborts([&] { Fixed insertion(one, sampled, 1 / 8000.0, Solver::exact, 0, Direction::motion); }));
#ifndef _WIN32
  CHECK(!aborts([&] { Fixed insertion(walls(3), sampled, T); }));
#endif
}
