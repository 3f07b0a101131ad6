// A loop with models that no scene file describes.
#include <doctest/doctest.h>

#include "core/support/allocations.hpp"
#include "core/support/cut_law.hpp"
#include "core/support/given_law.hpp"
#include "core/support/tick.hpp"
#include "punctura_runtime/loop/servo_loop.hpp"
#include "runtime/support/hand_cranked.hpp"

using namespace punctura;
using namespace punctura::test;

namespace {

CutLaw cut_law(const Needle&, const Membrane&, std::size_t) { return {}; }
const StepMaker cuts = StepMaker::with_laws(cut_law);

/// A loop with a model, armed, after the ramp, 2 mm in the tissue.
struct FeltRun {
  explicit FeltRun(const StepMaker& model, ForceLimits limits = {}) {
    auto made = std::make_unique<HandCranked>();
    device = made.get();
    LoopSettings settings;
    settings.model = model;
    settings.limits = limits;
    loop = std::make_unique<ServoLoop>(std::move(made), paper_scene(), settings);
    loop->start();
    loop->arm();
    device->move(2e-3, 1e-3, 1600);
    device->move(1e-3, -2e-3, 1600);
  }
  /// Rests and returns the largest change of the force from one tick to the next, N.
  double largest_step(int ticks) {
    double last = loop->latest().force[1], largest = 0;
    for (int k = 0; k < ticks; ++k) {
      const double now = device->tick(-2e-3)[1];
      largest = std::max(largest, std::abs(now - last));
      last = now;
    }
    return largest;
  }
  HandCranked* device;
  std::unique_ptr<ServoLoop> loop;
};

/// A model that gives 1 N, or what it is told to, as soon as it is stepped.
struct Pushes {
  using Scalar = double;
  using StoredIn = HeapStorage;
  double force = 1;
  Vector3d p{};

  void reset() noexcept {}
  void resume(Pushes&) noexcept {}
  Vector3d step(const Vector3d& position, const Vector3d&) noexcept {
    p = position;
    return {0, force, 0};
  }
  const Vector3d& tip() const noexcept { return p; }
  bool uses_axis() const noexcept { return true; }
  bool outside() const noexcept { return p.y() > 0; }
  std::size_t size() const noexcept { return 1; }
  SpaceTick<double> tick(std::size_t) const noexcept { return {}; }
  double cos_beta(std::size_t) const noexcept { return 1; }
};
StepMaker pushes(double force) {
  return {[force](const Scene&, std::vector<Problem>&) { return std::optional(Pushes{force}); }};
}

}  // namespace

TEST_CASE("a loop runs a law of your own, with memory, behind gate and limits") {
  FeltRun felt(cuts);
  felt.device->move(-2e-3, -6e-3, 400);
  CHECK(felt.loop->latest().force[1] == doctest::Approx(1));
  felt.device->move(-6e-3, 1e-3, 400);
  felt.device->move(1e-3, -3e-3, 400);
  CHECK(felt.loop->latest().force == zero);  // the hole is there
  const std::size_t before = allocations();
  felt.device->move(-3e-3, -8e-3, 400);
  CHECK(allocations() == before);
  CHECK(felt.loop->latest().force[1] == doctest::Approx(1));
  CHECK(felt.device->tick(reading(999999, 0)) == zero);  // the clock jumps
  CHECK(felt.loop->latest().fault == Fault::missed_deadline);
}

TEST_CASE("a scene keeps the model of the loop, and the cut") {
  FeltRun felt(cuts);
  Scene scene = paper_scene();
  scene.display.force_scale = 0.5;
  felt.loop->exchange(scene);
  felt.device->move(-2e-3, -6e-3, 400);
  CHECK(felt.loop->latest().force[1] == doctest::Approx(0.5));
  felt.device->move(-6e-3, 1e-3, 400);
  felt.device->move(1e-3, -3e-3, 400);
  CHECK(felt.loop->latest().force == zero);
}

TEST_CASE("a model of another kind begins afresh: the force fades, and the run goes on") {
  ForceLimits limits;
  limits.max_force = 0.5;
  for (const bool to_own : {true, false}) {
    FeltRun felt(to_own ? StepMaker() : cuts, limits);
    felt.device->move(-2e-3, -2e-3, 1600);
    const Snapshot before = felt.loop->latest();
    REQUIRE(before.force[1] > 0.2);
    felt.loop->exchange(paper_scene(), to_own ? cuts : StepMaker());
    CHECK(felt.largest_step(1) < 0.01);
    const Snapshot first = felt.loop->latest();
    CHECK(first.tick == before.tick + 1);
    CHECK(first.commands == command_scene);
    CHECK(first.state == ServoState::active);
    CHECK(first.limits.peak >= before.limits.peak);
    CHECK(first.limits.ramp == before.limits.ramp);
    CHECK(first.ceiling == doctest::Approx(before.ceiling));
    CHECK(first.membranes[0].phase == Phase::barred);

    CHECK(felt.largest_step(640) < 0.01);
    CHECK(felt.loop->latest().force == zero);  // until the tip has been outside
    felt.device->move(-2e-3, 1e-3, 400);
    CHECK(felt.device->move(1e-3, -2e-3, 800)[1] == doctest::Approx(0.5).epsilon(0.5));
  }
}

TEST_CASE("a model of another kind takes over fault and budget, and clears neither") {
  FeltRun felt(cuts);
  DeviceSample bad = reading(1, 0);
  bad.healthy = false;
  felt.device->tick(bad);
  felt.loop->exchange(paper_scene(), StepMaker());
  CHECK(felt.device->tick(1e-3) == zero);
  CHECK(felt.loop->latest().state == ServoState::faulted);
  CHECK(felt.loop->latest().fault == Fault::device);

  auto cut = AnyStep::of(build<double>(paper_scene(), cut_law)), other = AnyStep::of(build(paper_scene()));
  cut->guard().set_spent(1.5);
  other->resume(*cut);
  CHECK(other->guard().spent() == 1.5);
}

TEST_CASE("a loop runs each rival, and a scene keeps it") {
  AnyRival::for_each_kind([]<typename R>(const R& rival) {
    CAPTURE(R::name);
    FeltRun felt(StepMaker::with_rivals({AnyRival(RivalRun<R>{rival, {}})}));
    const std::size_t before = allocations();
    felt.device->move(-2e-3, -2.5e-3, 160);
    CHECK(allocations() == before);
    CHECK(felt.loop->latest().force[1] > 0.01);
    CHECK(felt.loop->latest().force == felt.loop->latest().model_force);
    felt.loop->exchange(paper_scene());
    felt.device->tick(-2.5e-3);
    CHECK(felt.loop->latest().membranes[0].phase != Phase::barred);
  });
}

TEST_CASE("no model goes around the guard, whatever force it asks for") {
  FeltRun strong(pushes(100));
  CHECK(strong.loop->latest().model_force[1] == 100);
  CHECK(strong.loop->latest().force[1] == doctest::Approx(strong.loop->latest().ceiling));
  CHECK(strong.loop->latest().ceiling < ForceLimits{}.max_force);
  FeltRun broken(pushes(std::numeric_limits<double>::quiet_NaN()));
  CHECK(broken.loop->latest().force == zero);
  CHECK(broken.loop->latest().fault == Fault::non_finite_force);

  // a model that gives its force at once, also in the tissue: the guard bars it until the tip has been in front
  FeltRun felt{StepMaker()};
  felt.loop->exchange(paper_scene(), pushes(1));
  for (int scene = 0; scene < 2; ++scene) {  // another scene for the same model does not end this
    CHECK(felt.largest_step(640) < 0.01);
    CHECK(felt.loop->latest().force == zero);
    CHECK(felt.loop->latest().model_force == zero);
    felt.loop->exchange(paper_scene());
  }
  felt.device->move(-2e-3, 0, 100);
  CHECK(felt.device->tick(1e-6)[1] < 0.01);  // and then fades it in
  CHECK(felt.device->move(1e-3, -2e-3, 640)[1] == doctest::Approx(1));
}

TEST_CASE("a model of your own gets only a scene that is whole, and its laws and coupling are checked") {
  using Table = GivenLaw<2>;
  const Table grip{{{0}, {{{}, {0, {-1}, {1}}}}}}, pulls{{{0}, {{{}, {0, {1}, {2}}}}}};
  const auto model = [](const Table& law, double g) {
    return StepMaker([=](const Scene& scene, std::vector<Problem>&) {
      const SiteOf<Table> site[] = {{law, to_vector(scene.membranes.at(0).point), {0, -1, 0}}};
      SampledCoupling<double> coupling({400, 1}, T);
      coupling.g = g;
      return std::optional(InsertionOf<Table>(site, coupling, T));
    });
  };
  const auto problem = [](const StepMaker& maker, const Scene& scene) {
    try {
      maker(scene, {}, {});
    } catch (const SceneError& error) {
      return line_of(error.problems().at(0));
    }
    return std::string();
  };
  CHECK(problem(model(grip, 2000), paper_scene()).empty());
  CHECK(problem(model(pulls, 2000), paper_scene()).starts_with("membrane[0]: the law: its lower edge"));
  CHECK(problem(model(grip, -1), paper_scene()).starts_with("coupling.g = -1: must be"));
  Scene empty = paper_scene();
  empty.membranes.clear();
  empty.display.automatic = true;
  CHECK(problem(pushes(1), empty).find("at least one membrane") != std::string::npos);
}

TEST_CASE("problems of scene, limits and model are told together, and the old model continues") {
  FeltRun felt(cuts);
  Scene scene = paper_scene();
  scene.membranes.push_back(scene.membranes[0]);
  try {
    felt.loop->exchange(scene, pushes(1));
    FAIL("a model with too few walls");
  } catch (const SceneError& error) {
    REQUIRE(error.problems().size() == 1);
    CHECK(error.problems()[0].path == "membrane");
  }
  felt.device->move(-2e-3, -6e-3, 400);
  CHECK(felt.loop->latest().force[1] == doctest::Approx(1));
}
